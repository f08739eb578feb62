// SPDX-License-Identifier: Apache-2.0
/// Spheres, full or partial. Full ones are sampled by the cone of directions in which they are seen
/// (Shirley et al. 1996, "Monte Carlo techniques for direct lighting calculations"), in a form that
/// stays precise for spheres that look tiny.
#include <cmath>

#include "core/frame.h"
#include "core/huge_page_object.h"
#include "core/rejections.h"
#include "core/sampling.h"
#include "shapes/quadric.h"
#include "shapes/registry.h"

namespace lampyris {

namespace {

struct SphereParameters {
  float radius = 1;
  std::optional<float> zMin, zMax;
  float phiMax = 360;

  void declare(Declaration& d) {
    d.add("radius", radius, "Radius.").atLeast(0);
    d.add("zmin", zMin, "Cut off below this z.")
        .defaultIs("-radius")
        .rangeIs("any; clamped to the radius");
    d.add("zmax", zMax, "Cut off above this z.")
        .defaultIs("radius")
        .rangeIs("any; clamped to the radius");
    d.add("phimax", phiMax, "Sweep about the z axis, in degrees.").clamped(0, 360);
  }
};

class Sphere final : public Quadric, public HugePageObject {
 public:
  Sphere(const SphereParameters& p, const ShapeContext& context);

  Ball ball(uint32_t element) const override;
  std::optional<ShapeHit> intersect(uint32_t element, const Ray& ray) const override;
  std::optional<ShapeSample> sampleSolidAngle(uint32_t element, const Vec3& from,
                                              const Vec2& u) const override;
  float pdfSolidAngle(uint32_t element, const Vec3& from, const Vec3& p,
                      const Vec3& n) const override;
  NormalCone normalCone(uint32_t element) const override { return (void)element, NormalCone{}; }

 protected:
  Point evaluate(DVec2 uv) const override;
  DVec2 sampleParameters(const Vec2& u) const override {
    return {u.x, vOf(zMin_ + static_cast<double>(u.y) * (zMax_ - zMin_))};
  }

 private:
  /// The polar angle runs from zmin (v = 0) to zmax (v = 1).
  double vOf(double z) const {
    return (std::acos(std::clamp(z / radius_, -1., 1.)) - thetaMin_) / (thetaMax_ - thetaMin_);
  }
  DVec2 parametersOf(const DVec3& p) const { return {azimuth(p.x, p.y) / phiMax_, vOf(p.z)}; }
  std::optional<DVec2> accept(const DVec3& p) const;
  /// In which the sphere is seen from a point. Empty where it is not sampled by its cone: partial,
  /// under a map that makes it no sphere, or from inside.
  struct Cone {
    DVec3 toCentre;
    double distance2, sin2, cos;  ///< of the half-angle; sin2 0: empty
    bool empty() const { return !(sin2 > 0); }
    double oneMinusCos() const { return sin2 / (1 + cos); }
    float pdf() const { return uniformConePdf(static_cast<float>(oneMinusCos())); }
  };
  Cone coneFrom(const Vec3& from) const;
  std::optional<ShapeSample> sampleCone(const Cone& cone, const Vec2& u) const;

  double radius_, zMin_, zMax_, phiMax_, thetaMin_, thetaMax_;
  bool full_;
};

Sphere::Sphere(const SphereParameters& p, const ShapeContext& context)
    : Quadric(context, "sphere"), radius_(p.radius), phiMax_(sweepAngle(p.phiMax)) {
  const double z0 = p.zMin.value_or(-p.radius), z1 = p.zMax.value_or(p.radius);
  zMin_ = std::clamp(std::min(z0, z1), -radius_, radius_);
  zMax_ = std::clamp(std::max(z0, z1), -radius_, radius_);
  thetaMin_ = radius_ > 0 ? std::acos(std::clamp(zMin_ / radius_, -1., 1.)) : 0;
  thetaMax_ = radius_ > 0 ? std::acos(std::clamp(zMax_ / radius_, -1., 1.)) : 0;
  full_ = zMin_ == -radius_ && zMax_ == radius_ && p.phiMax >= 360;
  if (full_) setBallRadius(radius_ * similarity());

  Extent extent;
  extent.area = phiMax_ * radius_ * (zMax_ - zMin_);
  const double nearest = zMin_ <= 0 && zMax_ >= 0 ? 0 : std::min(std::abs(zMin_), std::abs(zMax_));
  extent.axisRadius = safeSqrt(std::max(0., radius_ * radius_ - nearest * nearest));
  extent.originRadius = radius_;
  DVec2 lo, hi;
  arcBounds(extent.axisRadius, phiMax_, lo, hi);
  // Circles nearer to the poles are smaller, down to the axis.
  extent.min = DVec3(glm::min(lo, DVec2(0)), zMin_);
  extent.max = DVec3(glm::max(hi, DVec2(0)), zMax_);
  finish(extent);
}

Quadric::Point Sphere::evaluate(DVec2 uv) const {
  const double phi = uv.x * phiMax_, range = thetaMax_ - thetaMin_;
  const double theta = thetaMin_ + uv.y * range;
  const DVec2 around(std::cos(phi), std::sin(phi));
  Point at;
  at.n = DVec3(std::sin(theta) * around, std::cos(theta));
  at.p = radius_ * at.n;
  // At the poles dpdu vanishes; a small circle around them stands in for it, as in pbrt-v3.
  const double s = std::max(std::sin(theta), 1e-5), c = std::cos(theta);
  const DVec3 turned(-around.y, around.x, 0);
  at.dpdu = phiMax_ * radius_ * s * turned;
  at.dpdv = range * radius_ * DVec3(c * around, -s);
  at.dpduu = -phiMax_ * phiMax_ * radius_ * s * DVec3(around, 0);
  at.dpduv = range * phiMax_ * radius_ * c * turned;
  at.dpdvv = -range * range * radius_ * DVec3(s * around, c);
  return at;
}

Ball Sphere::ball(uint32_t element) const {
  (void)element;
  if (!(similarity() > 0)) return {};
  // What a similarity may be off by, and the rounding of the centre.
  const double slack = 1e-4 * radius_ * similarity() +
                       static_cast<double>(kMachineEpsilon) * glm::length(worldOrigin());
  return {Vec3(worldOrigin()), nextFloatUp(static_cast<float>(radius_ * similarity() + slack))};
}

/// The parameters of a point on the whole sphere if the cuts leave it.
std::optional<DVec2> Sphere::accept(const DVec3& p) const {
  if (full_) return parametersOf(p);
  if ((zMin_ > -radius_ && p.z < zMin_) || (zMax_ < radius_ && p.z > zMax_)) return std::nullopt;
  const DVec2 uv = parametersOf(p);
  if (uv.x > 1) return std::nullopt;
  return uv;
}

std::optional<ShapeHit> Sphere::intersect(uint32_t element, const Ray& ray) const {
  (void)element;
  if (isEmpty()) return std::nullopt;
  const DVec3 o = objectPoint(ray.o), d = objectVector(ray.d);
  // The discriminant by the distance of the line from the centre: no difference of large squares
  // for rays from afar (Haines et al. 2019, "Precision Improvements for Ray/Sphere Intersection").
  const double a = glm::dot(d, d), halfB = glm::dot(o, d);
  const DVec3 foot = o - (halfB / a) * d;
  const double reach = radius_ * radius_ - glm::dot(foot, foot);
  const double far = glm::length(o);
  const Roots roots = quadraticRoots(a, halfB, (far - radius_) * (far + radius_), a * reach);
  for (int i = 0; i < roots.count; ++i) {
    const auto t = static_cast<float>(roots.t[i]);
    if (!(t > 0 && t < ray.tMax)) continue;
    const DVec3 p = o + roots.t[i] * d;
    if (const auto uv = accept(p * (radius_ / glm::length(p)))) return ShapeHit{t, Vec2(*uv)};
  }
  return std::nullopt;
}

/// Not an optional: that would be copied through memory in pieces of another size than it is
/// written in, for which the processor waits.
inline Sphere::Cone Sphere::coneFrom(const Vec3& from) const {
  const double r = ballRadius();
  const DVec3 toCentre = worldOrigin() - DVec3(from);
  const double d2 = glm::dot(toCentre, toCentre);
  const bool outside = r > 0 && d2 > r * r && std::isfinite(d2);
  const double sin2 = outside ? r * r / d2 : 0;
  return {toCentre, d2, sin2, safeSqrt(1 - sin2)};
}

std::optional<ShapeSample> Sphere::sampleSolidAngle(uint32_t element, const Vec3& from,
                                                    const Vec2& u) const {
  const Cone cone = coneFrom(from);
  return cone.empty() ? Shape::sampleSolidAngle(element, from, u) : sampleCone(cone, u);
}

std::optional<ShapeSample> Sphere::sampleCone(const Cone& cone, const Vec2& u) const {
  std::optional<ShapeSample> out;
  const float pdf = cone.pdf();
  if (!(area(0) > 0)) return out;
  if (!std::isfinite(pdf)) {
    countRejection(Rejection::LightDensity);
    return out;
  }

  // A direction at θ from the axis meets the sphere at the angle α from the axis, as seen from the
  // centre: α = asin(k) − θ with k = sin θ / sin θmax. From 1 − cos θ = u (1 − cos θmax) follows
  // k² = u (1 + cos θ) / (1 + cos θmax). Written such that few roots and quotients wait for others.
  const double h = static_cast<double>(u.x) / (1 + cone.cos), cosTheta = 1 - h * cone.sin2;
  const double k2 = std::min(1., h * (1 + cosTheta));
  const double k = std::sqrt(k2), rest = std::sqrt(1 - k2), sin = std::sqrt(cone.sin2);
  const double cosAlpha = k2 * sin + cosTheta * rest;
  const double sinAlpha = k * (cosTheta - sin * rest);
  const DVec3 axis = cone.toCentre / std::sqrt(cone.distance2);
  // Azimuth and frame are good to float precision, which turns the draw as a whole by that much.
  const Vec2 around = circlePoint(u.y);
  const Frame frame = Frame::fromZ(Vec3(-axis));
  const DVec3 n = sinAlpha * DVec3(around.x * frame.x + around.y * frame.y) - cosAlpha * axis;
  ShapeSample& s = out.emplace();
  // The map may be off from a similarity by its rounding: M Mᵀn / |Mᵀn| is on the surface exactly.
  // The length is 1 but for rounding in single precision, so the root's tangent is its inverse.
  const DVec3 mapped = corrected(n);
  const double inverseLength = 1.5 - 0.5 * glm::dot(n, mapped);
  s.p = Vec3(worldOrigin() + ballRadius() * inverseLength * mapped);
  s.pError = worldError(s.p);
  s.n = orientation() * Vec3(n);
  s.pdf = pdf;
  return out;
}

float Sphere::pdfSolidAngle(uint32_t element, const Vec3& from, const Vec3& p,
                            const Vec3& n) const {
  const Cone cone = coneFrom(from);
  if (cone.empty()) return Shape::pdfSolidAngle(element, from, p, n);
  // The far side is never drawn. On the silhouette rounding of p decides nothing.
  const DVec3 fromCentre = DVec3(p) - worldOrigin(), back = DVec3(from) - DVec3(p);
  const double reach = glm::length(worldOrigin()) + 2 * ballRadius();  // of its points at most
  const double tolerance =
      8 * static_cast<double>(kMachineEpsilon) * reach * std::sqrt(cone.distance2);
  if (glm::dot(fromCentre, back) < -tolerance) return 0;
  const float pdf = cone.pdf();
  return std::isfinite(pdf) && area(element) > 0 ? pdf : 0;
}

std::unique_ptr<Shape> create(const SphereParameters& p, const ShapeContext& context) {
  return std::make_unique<Sphere>(p, context);
}

}  // namespace

ShapeRegistry::Entry spherePlugin() {
  return makePlugin("sphere", "Sphere about the origin, or a part of it.", create);
}

}  // namespace lampyris
