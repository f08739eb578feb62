// SPDX-License-Identifier: Apache-2.0
/// A triangle as seen from a point: its solid angle and uniform directions within it.
///
/// The solid angle is Van Oosterom and Strackee's (1983, "The Solid Angle of a Plane Triangle").
/// The warp is that of Arvo (1995, "Stratified Sampling of Spherical Triangles"): a point C' on the
/// side from A to C such that A B C' has a given part of the solid angle, then a point on the arc
/// from B to C'. Arvo goes by the angles of the triangle, whose sum less π cancels for small ones.
/// Here C' comes from the same formula as the solid angle. With C' = cos s A + sin s T, T unit and
/// orthogonal to A in the plane of A and C, and half the wanted solid angle h,
///
///   tan h = t det(A, B, T) / ((1 + A·B) + t B·T)  for t = tan(s / 2),
///
/// which is linear in t. No difference of nearly equal numbers is left for small triangles, and as
/// all vectors are combinations of A, B and C, the result is in barycentric coordinates: the point
/// is on the triangle and no ray has to be cut with its plane.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/sampling.h"

namespace lampyris {

/// Flat surfaces whose two edges, squared and added, are less than this part of the squared
/// distance of their centroid are sampled by area: see docs/shape-sampling.md.
inline constexpr double kWide = 0.1;

/// An angle in [0, π] as a vector of any length that points there. Half the solid angle of what
/// lies in front of a point is one; sums and differences take no trigonometry.
struct HalfAngle {
  double cos = 1, sin = 0;

  /// Of a share of the solid angle, given the whole in steradian.
  static HalfAngle ofSolidAngle(float part) {
    const Vec2 p = circlePoint(part * (1 / (4 * kPi)));
    return {p.x, p.y};
  }
  HalfAngle operator+(const HalfAngle& o) const {
    return {cos * o.cos - sin * o.sin, sin * o.cos + cos * o.sin};
  }
  HalfAngle operator-(const HalfAngle& o) const {
    return {cos * o.cos + sin * o.sin, sin * o.cos - cos * o.sin};
  }
  /// Twice the angle, in steradian, to float precision; 0 below what floats can tell from it.
  float solidAngle() const;
};

/// A corner in relation to the point: what triangles that share it share.
struct SeenCorner {
  explicit SeenCorner(const glm::dvec3& at)
      : at(at), inverseDistance(1 / std::sqrt(glm::dot(at, at))) {}
  glm::dvec3 at;
  double inverseDistance;
};

class SphericalTriangle {
 public:
  /// `volume` is |det(a, b, c)|, which callers know more precisely than these: it is the distance
  /// from the plane times twice the area. 0: the point is in the plane or at a corner.
  SphericalTriangle(const SeenCorner& a, const SeenCorner& b, const SeenCorner& c, double volume);

  const HalfAngle& half() const { return half_; }
  /// In steradian, up to 2π.
  float solidAngle() const { return half_.solidAngle(); }
  /// Barycentric coordinates of a point on the arc from b to where the triangle, swept from a to c,
  /// has half the solid angle `swept`; uniform by solid angle if that and `u` are. Each is ≥ 0 and
  /// their sum is 1 up to rounding. Not to be called where volume is 0.
  Vec3 sample(const HalfAngle& swept, float u) const;

 private:
  double a_, b_, c_;     ///< inverse distances
  double ab_, bc_, ca_;  ///< cosines of the sides
  double volume_;        ///< for unit distances
  HalfAngle half_;
};

inline float HalfAngle::solidAngle() const {
  const auto sine = static_cast<float>(sin), cosine = static_cast<float>(cos);
  if (!(sine > 0)) return cosine < 0 ? 2 * kPi : 0;
  const float across = std::abs(cosine);
  const bool steep = sine > across;
  const float r = steep ? across / sine : sine / across, t = r * r, t2 = t * t, t4 = t2 * t2;
  // atan(r) / r on [0, 1], minimax.
  const float low = (1 - 0.333330721f * t) + t2 * (0.199926198f - 0.142036453f * t);
  const float high =
      (0.106409349f - 7.50429556e-2f * t) + t2 * (4.26915251e-2f - 1.60686296e-2f * t);
  const float angle = r * (low + t4 * (high + t4 * 2.84988945e-3f));
  const float folded = steep ? kPi / 2 - angle : angle;
  return 2 * (cosine < 0 ? kPi - folded : folded);
}

inline SphericalTriangle::SphericalTriangle(const SeenCorner& a, const SeenCorner& b,
                                            const SeenCorner& c, double volume)
    : a_(a.inverseDistance),
      b_(b.inverseDistance),
      c_(c.inverseDistance),
      ab_(glm::dot(a.at, b.at) * (a_ * b_)),
      bc_(glm::dot(b.at, c.at) * (b_ * c_)),
      ca_(glm::dot(c.at, a.at) * (c_ * a_)),
      volume_(volume * (a_ * b_ * c_)) {
  if (volume > 0) half_ = {1 + ab_ + bc_ + ca_, volume_};
}

inline Vec3 SphericalTriangle::sample(const HalfAngle& swept, float u) const {
  // C' = x A + y C, by q = t / sin b = numerator / denominator where sin b = |C − (A·C) A|.
  // Rounding may make A and C opposite, or B and C', where the point is next to an edge.
  constexpr double kLeast = 1e-16;
  const double opposite = std::max(1 + ca_, kLeast);
  double numerator = std::max(0., swept.sin) * (1 + ab_);
  double denominator = volume_ * swept.cos - (bc_ - ca_ * ab_) * swept.sin;
  if (!(numerator * opposite < denominator)) numerator = 1, denominator = opposite;  // C' = C
  const double d2 = sqr(denominator), t2 = sqr(numerator) * (1 - ca_) * opposite;
  const double k = 1 / (d2 + t2);
  const double y = 2 * numerator * denominator * k, x = std::max(0., (d2 - t2) * k - ca_ * y);
  // P = B + g (C' − (B·C') B) − v B, with 1 − B·P = v = u (1 − B·C').
  const double m = std::max(0., 1 - (x * ab_ + y * bc_)), v = static_cast<double>(u) * m;
  const double g = std::sqrt(static_cast<double>(u) * (2 - v) / std::max(2 - m, kLeast));
  const double z = std::max(0., 1 - v - g * (1 - m));
  const glm::dvec3 w(g * x * a_, z * b_, g * y * c_);
  return Vec3(w * (1 / (w.x + w.y + w.z)));
}

}  // namespace lampyris
