// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "shapes/registry.h"
#include "shapes/revolved_quadric.h"

namespace lampyris {

namespace {

struct HyperboloidParameters {
  Vec3 p1{0, 0, 0}, p2{1, 1, 1};
  float phiMax = 360;

  void declare(Declaration& d) {
    d.add("p1", p1, "Start of the line that is turned about the z axis.").any();
    d.add("p2", p2, "End of the line.").any();
    d.add("phimax", phiMax, "Sweep about the z axis, in degrees.").clamped(0, 360);
  }
};

/// radius² = a + b z².
struct Section {
  double a = 0, b = 0;
};

/// pbrt-v3's surface: it goes through `p2` and a point of the line beyond, and is symmetric about
/// z = 0. So it contains the line from `p1` only if that is nearest to the axis at z = 0.
Section sectionThrough(const DVec3& p1, const DVec3& p2) {
  const auto radius2 = [](const DVec3& p) { return p.x * p.x + p.y * p.y; };
  const auto z2 = [](const DVec3& p) { return p.z * p.z; };
  DVec3 beyond = p1 + 2. * (p2 - p1);
  if (z2(beyond) == z2(p2)) beyond += 2. * (p2 - p1);
  Section s;
  s.b = (radius2(beyond) - radius2(p2)) / (z2(beyond) - z2(p2));
  s.a = radius2(p2) - s.b * z2(p2);
  return s;
}

/// The area of the surface below a z, a turn by one radian wide: ∫ √(a + c z²) dz with
/// c = b (1 + b), where there is a surface; counted from z = 0.
class SweptArea {
 public:
  explicit SweptArea(const Section& s) : a_(s.a), c_(s.b * (1 + s.b)) {
    if (s.a < 0) inner_ = s.b > 0 ? std::sqrt(-s.a / s.b) : HUGE_VAL;
    if (s.b < 0) outer_ = s.a > 0 ? std::sqrt(s.a / -s.b) : 0;
    if (inner_ < outer_) atInner_ = antiderivative(inner_);
  }
  double density(double z) const {
    const double m = std::abs(z);
    return m < inner_ || m > outer_ ? 0 : std::sqrt(std::max(0., a_ + c_ * m * m));
  }
  double below(double z) const {
    if (!(inner_ < outer_)) return 0;
    const double m = std::clamp(std::abs(z), inner_, outer_);
    return std::copysign(antiderivative(m) - atInner_, z);
  }

 private:
  /// Of √(a + c m²), m ≥ 0.
  double antiderivative(double m) const {
    double inverse = 0;  // ∫ dm / √(a + c m²)
    if (a_ != 0) {
      const double root = std::sqrt(std::abs(c_)), x = m * std::sqrt(std::abs(c_ / a_));
      if (c_ == 0)
        inverse = m / std::sqrt(a_);
      else if (a_ < 0)
        inverse = std::acosh(std::max(1., x)) / root;
      else
        inverse = (c_ > 0 ? std::asinh(x) : std::asin(std::min(1., x))) / root;
    }
    return 0.5 * (m * std::sqrt(std::max(0., a_ + c_ * m * m)) + a_ * inverse);
  }

  double a_, c_, inner_ = 0, outer_ = HUGE_VAL, atInner_ = 0;
};

class Hyperboloid final : public RevolvedQuadric {
 public:
  Hyperboloid(DVec3 p1, DVec3 p2, float phiMax, const ShapeContext& context)
      : RevolvedQuadric(context, "hyperboloid"),
        section_(sectionThrough(p1, p2)),
        swept_(section_) {
    Profile profile;
    profile.c0 = section_.a;
    profile.c2 = section_.b;
    profile.zAt0 = p1.z;
    profile.zAt1 = p2.z;
    profile.start = DVec2(p1);
    profile.end = DVec2(p2);
    profile.phiMax = sweepAngle(phiMax);
    begin_ = swept_.below(profile.zMin());
    end_ = swept_.below(profile.zMax());
    finishProfile(profile, profile.phiMax * (end_ - begin_));
  }

  /// pbrt-v3 shades with the normal of the turned line, not with that of the surface it meets.
  void surface(uint32_t element, const ShapeHit& hit, const Ray& ray, SurfaceDetail detail,
               SurfaceInteraction& out) const override {
    Quadric::surface(element, hit, ray, detail, out);
    const Profile& p = profile();
    const double v = hit.uv.y;
    const DVec2 along = p.end - p.start, line = p.start + v * along;
    const double radius = glm::length(line);
    if (!(radius > 0)) return;
    const double widening = glm::dot(line, along) / radius;
    const DVec2 outward = glm::normalize(DVec2(evaluate(hit.uv).n));
    const double height = p.zAt1 - p.zAt0, sign = height < 0 ? -1 : 1;
    const Vec3 n = worldNormal(sign * DVec3(height * outward, -widening));
    if (isFinite(n)) out.shading.n = faceForward(n, out.n);
  }

 protected:
  DVec2 sampleParameters(const Vec2& u) const override {
    const Profile& p = profile();
    const double wanted = begin_ + static_cast<double>(u.y) * (end_ - begin_);
    // Newton's method, kept between ends that close in.
    double lo = p.zMin(), hi = p.zMax(), z = lo + static_cast<double>(u.y) * (hi - lo);
    const double tolerance = 1e-13 * (hi - lo);
    for (int i = 0; i < 100; ++i) {
      const double excess = swept_.below(z) - wanted;
      (excess < 0 ? lo : hi) = z;
      double next = z - excess / swept_.density(z);
      if (!(next > lo && next < hi)) next = 0.5 * (lo + hi);
      if (std::abs(next - z) <= tolerance) break;
      z = next;
    }
    return {u.x, p.vOf(z)};
  }

 private:
  Section section_;
  SweptArea swept_;
  double begin_ = 0, end_ = 0;
};

std::unique_ptr<Shape> create(const HyperboloidParameters& p, const ShapeContext& context) {
  DVec3 p1(p.p1), p2(p.p2);
  if (p2.z == 0) std::swap(p1, p2);  // as pbrt-v3, which matters for v
  return std::make_unique<Hyperboloid>(p1, p2, p.phiMax, context);
}

}  // namespace

ShapeRegistry::Entry hyperboloidPlugin() {
  return makePlugin("hyperboloid", "A line turned about the z axis.", create);
}

}  // namespace lampyris
