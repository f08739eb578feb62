// SPDX-License-Identifier: Apache-2.0
#include "shapes/curve_segment.h"

#include <algorithm>
#include <cmath>

namespace lampyris {

namespace {

using DVec2 = glm::dvec2;
using DVec3 = glm::dvec3;

/// Whether a ray's line misses the ball around the curve: the cheap answer for most boxes that rays
/// meet.
bool passesBall(const CubicBezier& c, double halfWidth, const DVec3& origin, const DVec3& w) {
  const DVec3 centre = 0.5 * (c.p[0] + c.p[3]);
  double radius2 = 0;
  for (const DVec3& p : c.p) radius2 = std::max(radius2, glm::dot(p - centre, p - centre));
  const DVec3 away = glm::cross(centre - origin, w);
  const double reach = std::sqrt(radius2) + halfWidth;
  return glm::dot(away, away) > reach * reach;
}

/// A frame with z along the ray and the chord of the curve in the plane of x and z: boxes of the
/// curve's pieces are tight there.
struct RayFrame {
  RayFrame(const DVec3& direction, const DVec3& chord) : z(direction) {
    x = chord - glm::dot(chord, z) * z;
    double size = glm::length(x);
    if (!(size > 1e-9 * glm::length(chord))) {
      x = std::abs(z.x) < 0.6 ? DVec3(1, 0, 0) : DVec3(0, 1, 0);
      x -= glm::dot(x, z) * z;
      size = glm::length(x);
    }
    x /= size;
    y = glm::cross(z, x);
  }
  DVec3 toLocal(const DVec3& v) const { return {glm::dot(v, x), glm::dot(v, y), glm::dot(v, z)}; }
  DVec3 x, y, z;
};

/// Splits the curve in the ray's frame, keeps what is near the ray, and solves for the nearest
/// point of nearly straight pieces.
class Search {
 public:
  Search(const CurveSegment& segment, const DVec3& direction, double zMax)
      : segment_(segment), direction_(direction), zMax_(zMax) {}

  std::optional<CurveHit> run(const CubicBezier& c, double u0, double u1) {
    const double width = std::max(segment_.width(u0), segment_.width(u1));
    if (width > 0) descend(c, u0, u1, splits(c, width));
    return found_;
  }

 private:
  /// How often to halve the curve until pieces deviate from chords by at most 5 % of the width
  /// (Wang's bound, from the second differences).
  static int splits(const CubicBezier& c, double width) {
    double bend = 0;
    for (size_t i = 0; i < 2; ++i) {
      const DVec3 d = c.p[i] - 2. * c.p[i + 1] + c.p[i + 2];
      bend = std::max(bend, glm::length(DVec2(d)));
    }
    const double depth = 0.5 * std::log2(0.75 * bend / (0.05 * width));
    return static_cast<int>(std::ceil(std::clamp(depth, 0., 10.)));
  }

  bool isFar(const CubicBezier& c, double halfWidth) const {
    const DVec3 lo = glm::min(glm::min(c.p[0], c.p[1]), glm::min(c.p[2], c.p[3]));
    const DVec3 hi = glm::max(glm::max(c.p[0], c.p[1]), glm::max(c.p[2], c.p[3]));
    return lo.x > halfWidth || hi.x < -halfWidth || lo.y > halfWidth || hi.y < -halfWidth ||
           lo.z >= zMax_ || hi.z <= 0;
  }

  void descend(const CubicBezier& c, double u0, double u1, int depth) {
    if (isFar(c, 0.5 * std::max(segment_.width(u0), segment_.width(u1)))) return;
    if (depth == 0) {
      meet(c, u0, u1);
      return;
    }
    const double middle = 0.5 * (u0 + u1);
    const auto halves = c.halves();
    descend(halves[0], u0, middle, depth - 1);
    descend(halves[1], middle, u1, depth - 1);
  }

  void meet(const CubicBezier& c, double u0, double u1) {
    // The ray lies between the perpendiculars at the ends: there, the squared distance falls and
    // rises. So its minimum is in between.
    const auto slope = [&](double t) {
      return glm::dot(DVec2(c.point(t)), DVec2(c.derivative(t)));
    };
    double lo = 0, hi = 1, atLo = slope(0), atHi = slope(1);
    if (atLo > 0 || atHi < 0) return;
    double t = 0.5;
    for (int i = 0; i < 4 && atHi > atLo; ++i) {
      t = lo - atLo * (hi - lo) / (atHi - atLo);
      const double at = slope(t);
      (at < 0 ? lo : hi) = t;
      (at < 0 ? atLo : atHi) = at;
    }
    const double u = u0 + t * (u1 - u0);
    const DVec3 p = c.point(t);
    const double distance = glm::length(DVec2(p)), width = segment_.widthSeen(u, direction_);
    if (!(distance <= 0.5 * width) || !(p.z > 0 && p.z < zMax_) || !(width > 0)) return;
    const DVec3 along = c.derivative(t);
    const double side = p.x * along.y - p.y * along.x > 0 ? 1 : -1;
    zMax_ = p.z;
    found_ = CurveHit{p.z, u, 0.5 + side * distance / width};
  }

  const CurveSegment& segment_;
  const DVec3& direction_;
  double zMax_;
  std::optional<CurveHit> found_;
};

}  // namespace

CurveSegment::DVec3 CurveSegment::normal(double u) const {
  const double angle = std::acos(std::clamp(glm::dot(startNormal, endNormal), -1., 1.));
  const double sine = std::sin(angle);
  // Parallel normals: no arc to walk along, or too many.
  if (!(sine > 1e-6)) return u < 0.5 ? startNormal : endNormal;
  return (std::sin((1 - u) * angle) * startNormal + std::sin(u * angle) * endNormal) / sine;
}

double CurveSegment::widthSeen(double u, const DVec3& w) const {
  return oriented ? width(u) * std::abs(glm::dot(normal(u), w)) : width(u);
}

std::optional<CurveHit> CurveSegment::intersect(double u0, double u1, const DVec3& origin,
                                                const DVec3& w, double zMax) const {
  const CubicBezier piece = curve.piece(u0, u1);
  if (passesBall(piece, 0.5 * std::max(width(u0), width(u1)), origin, w)) return std::nullopt;
  const RayFrame frame(w, piece.p[3] - piece.p[0]);
  CubicBezier local;
  for (size_t i = 0; i < 4; ++i) local.p[i] = frame.toLocal(piece.p[i] - origin);
  return Search(*this, w, zMax).run(local, u0, u1);
}

}  // namespace lampyris
