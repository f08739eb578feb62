// SPDX-License-Identifier: Apache-2.0
#include "shapes/quadric.h"

#include <fmt/format.h>

#include <limits>

#include "core/error.h"

namespace lampyris {

namespace {

constexpr double kTwoPi = 2 * 3.14159265358979323846;

/// Rounding of the double-precision map, in relation to its terms; far above what a chain of a few
/// operations can gather, far below float precision.
constexpr double kDoubleError = 0x1p-48;

Vec3 unit(const DVec3& v) { return Vec3(v / glm::length(v)); }

}  // namespace

Quadric::Quadric(const ShapeContext& context, const char* name) {
  const glm::dmat4 m(context.objectToWorld.matrix());
  if (m[0][3] != 0 || m[1][3] != 0 || m[2][3] != 0 || m[3][3] != 1)
    throw SceneError(context.location,
                     fmt::format("{}: its transformation is projective; the last row of the matrix "
                                 "must be 0 0 0 1",
                                 name));
  matrix_ = glm::dmat3(m);
  translation_ = DVec3(m[3]);
  determinant_ = glm::determinant(matrix_);
  toObject_ = glm::inverse(matrix_);
  bool finite = std::isfinite(determinant_) && determinant_ != 0;
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 3; ++r)
      finite = finite && std::isfinite(toObject_[c][r]) && std::isfinite(translation_[r]);
  if (!finite)
    throw SceneError(
        context.location,
        fmt::format("{}: its transformation cannot be inverted; look for a Scale by 0", name));
  // Products of rotations in single precision stray this far from being orthogonal.
  constexpr double kTolerance = 1e-5, kExact = 1e-12;
  const glm::dmat3 gram = glm::transpose(matrix_) * matrix_;
  const double s2 = (gram[0][0] + gram[1][1] + gram[2][2]) / 3;
  double off = 0;
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 3; ++r) off = std::max(off, std::abs(gram[c][r] - (c == r ? s2 : 0)));
  similarity_ = off <= kTolerance * s2 ? std::sqrt(s2) : 0;
  exact_ = off <= kExact * s2;
  orientation_ = context.reverseOrientation ? -1.f : 1.f;
}

void Quadric::finish(const Extent& extent) {
  objectArea_ = extent.area;
  if (isEmpty()) return;
  area_ = static_cast<float>(objectArea_ * meanAreaScale());
  if (!(area_ >= std::numeric_limits<float>::min()) || !std::isfinite(area_)) area_ = 0;
  setBounds(extent);
  DVec3 terms = absComponents(translation_);
  const DVec3 farthest = glm::max(absComponents(extent.min), absComponents(extent.max));
  for (int c = 0; c < 3; ++c) terms += absComponents(matrix_[c]) * farthest[c];
  mapError_ = Vec3(kDoubleError * terms) + Vec3(std::numeric_limits<float>::denorm_min());
}

double Quadric::meanAreaScale() const {
  if (similarity_ > 0) return similarity_ * similarity_;
  // Smooth over uniform samples in equal steps: the midpoint rule is good to about 1e-6.
  constexpr int kSteps = 256;
  double sum = 0;
  for (int y = 0; y < kSteps; ++y) {
    for (int x = 0; x < kSteps; ++x) {
      const Vec2 u((static_cast<float>(x) + 0.5f) / kSteps,
                   (static_cast<float>(y) + 0.5f) / kSteps);
      sum += areaScale(evaluate(sampleParameters(u)).n);
    }
  }
  return sum / (kSteps * kSteps);
}

/// The intersection of the boxes around the mapped box, cylinder and ball.
void Quadric::setBounds(const Extent& extent) {
  const DVec3 middle = 0.5 * (extent.min + extent.max), half = 0.5 * (extent.max - extent.min);
  const DVec3 boxCentre = toWorld(middle), axisCentre = toWorld({0, 0, middle.z});
  for (int i = 0; i < 3; ++i) {
    const DVec3 row(matrix_[0][i], matrix_[1][i], matrix_[2][i]);
    const double box = glm::dot(absComponents(row), half);
    const double around = extent.axisRadius * std::hypot(row.x, row.y) + std::abs(row.z) * half.z;
    const double ball = extent.originRadius * glm::length(row);
    const double lo =
        std::max({boxCentre[i] - box, axisCentre[i] - around, translation_[i] - ball});
    const double hi =
        std::min({boxCentre[i] + box, axisCentre[i] + around, translation_[i] + ball});
    const double slack = kDoubleError * (std::abs(translation_[i]) + ball + box);
    bounds_.min[i] = nextFloatDown(static_cast<float>(lo - slack));
    bounds_.max[i] = nextFloatUp(static_cast<float>(hi + slack));
  }
}

Bounds3 Quadric::bounds(uint32_t element) const { return (void)element, bounds_; }

/// How much larger an area with that normal is in world space.
double Quadric::areaScale(const DVec3& objectNormal) const {
  return std::abs(determinant_) * glm::length(objectNormal * toObject_);
}

Vec3 Quadric::worldNormal(const DVec3& objectNormal) const {
  return orientation_ * unit(objectNormal * toObject_);
}

void Quadric::surface(uint32_t element, const ShapeHit& hit, const Ray& ray, SurfaceDetail detail,
                      SurfaceInteraction& out) const {
  (void)element;
  const Point at = evaluate(hit.uv);
  out.p = Vec3(toWorld(at.p));
  out.pError = worldError(out.p);
  out.n = worldNormal(at.n);
  out.uv = hit.uv;
  out.time = ray.time;
  const DVec3 du = matrix_ * at.dpdu, dv = matrix_ * at.dpdv;
  out.dpdu = Vec3(du);
  out.dpdv = Vec3(dv);
  out.dndu = out.dndv = Vec3(0);
  if (detail == SurfaceDetail::Full) {
    // The Weingarten equations in world space, where the map's scale and shear count.
    const DVec3 n(out.n);
    const double e1 = glm::dot(du, du), f1 = glm::dot(du, dv), g1 = glm::dot(dv, dv);
    const double e2 = glm::dot(n, matrix_ * at.dpduu), f2 = glm::dot(n, matrix_ * at.dpduv),
                 g2 = glm::dot(n, matrix_ * at.dpdvv);
    const double determinant = e1 * g1 - f1 * f1;
    if (determinant > 0) {
      out.dndu =
          Vec3((f2 * f1 - e2 * g1) / determinant * du + (e2 * f1 - f2 * e1) / determinant * dv);
      out.dndv =
          Vec3((g2 * f1 - f2 * g1) / determinant * du + (f2 * f1 - g2 * e1) / determinant * dv);
    }
  }
  out.shading = {out.n, out.dpdu, out.dpdv, out.dndu, out.dndv};
}

ShapeSample Quadric::sampleAt(DVec2 uv) const {
  const Point at = evaluate(uv);
  ShapeSample s;
  s.p = Vec3(toWorld(at.p));
  s.pError = worldError(s.p);
  s.n = worldNormal(at.n);
  return s;
}

std::optional<ShapeSample> Quadric::sampleArea(uint32_t element, const Vec2& u) const {
  if (!(area_ > 0)) return std::nullopt;
  ShapeSample s = sampleAt(sampleParameters(u));
  s.pdf = pdfArea(element, s.n);
  return s;
}

float Quadric::pdfArea(uint32_t element, const Vec3& n) const {
  (void)element;
  if (!(area_ > 0)) return 0;
  if (similarity_ > 0) return 1 / area_;
  // With n = M⁻ᵀ nₒ / |M⁻ᵀ nₒ| the area scale |det M| |M⁻ᵀ nₒ| is |det M| / |Mᵀ n|.
  return static_cast<float>(glm::length(DVec3(n) * matrix_) /
                            (std::abs(determinant_) * objectArea_));
}

double sweepAngle(float degrees) {
  return std::clamp(static_cast<double>(degrees), 0., 360.) / 360 * kTwoPi;
}

double azimuth(double x, double y) {
  const double phi = std::atan2(y, x);
  return phi < 0 ? phi + kTwoPi : phi;
}

void arcBounds(double radius, double phiMax, DVec2& min, DVec2& max) {
  min = max = DVec2(radius, 0);
  const auto extend = [&](DVec2 p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
  };
  extend(radius * DVec2(std::cos(phiMax), std::sin(phiMax)));
  if (phiMax >= kTwoPi / 4) extend({0, radius});
  if (phiMax >= kTwoPi / 2) extend({-radius, 0});
  if (phiMax >= kTwoPi * 3 / 4) extend({0, -radius});
}

}  // namespace lampyris
