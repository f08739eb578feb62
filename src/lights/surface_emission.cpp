// SPDX-License-Identifier: Apache-2.0
#include "lights/surface_emission.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/hash.h"
#include "core/parallel.h"

namespace lampyris {
namespace {

/// Least mean of an element, as a share of the shape's.
constexpr float kFloor = 0.01f;
/// Points on a shape, shared among its elements, within these limits for each.
constexpr double kPoints = 1 << 18;
constexpr int kMinSide = 2, kMaxSide = 16;

Rgb emittable(const Rgb& v) { return v.isFinite() ? clampPositive(v) : Rgb(); }

}  // namespace

SurfaceEmission::SurfaceEmission(const Shape& shape, const SpectrumTexture& texture,
                                 const Rgb& scale)
    : shape_(shape), texture_(&texture), scale_(scale) {
  estimateMeans(scale.luminance());
}

SurfaceEmission::SurfaceEmission(const Shape& shape, std::shared_ptr<const EmissionImage> picture,
                                 const Rgb& scale, const PictureMeans& means)
    : shape_(shape), picture_(std::move(picture)), scale_(scale) {
  if (shape.triangles().triangleCount == 0) {
    estimateMeans((picture_->mean() * scale).luminance());
    return;
  }
  means_.resize(shape.elementCount());
  parallelFor(means_.size(), 256, [&](size_t begin, size_t end) {
    for (size_t e = begin; e < end; ++e) {
      const auto corner = [&](const Vec2& barycentric) {
        SurfaceInteraction at;
        shape.surface(static_cast<uint32_t>(e), {0, barycentric}, Ray(), SurfaceDetail::Basic, at);
        return at.uv;
      };
      means_[e] = means.over({corner({0, 0}), corner({1, 0}), corner({0, 1})});
    }
  });
}

Rgb SurfaceEmission::valueAt(const Vec3& p, const Vec2& uv) const {
  if (picture_) return emittable(scale_ * picture_->bilinear({uv.x, 1 - uv.y}));
  SurfaceInteraction place;
  place.p = p;
  place.uv = uv;
  return emittable(scale_ * texture_->evaluate(place));
}

Rgb SurfaceEmission::at(uint32_t element, const Vec3& p, const Vec3& n) const {
  const auto hit = shape_.locate(element, p, n);
  if (!hit) return Rgb();
  SurfaceInteraction at;
  shape_.surface(element, *hit, Ray(), SurfaceDetail::Basic, at);
  return valueAt(p, at.uv);
}

float SurfaceEmission::estimateMean(uint32_t element, int side) const {
  double sum = 0, weights = 0;
  for (int i = 0; i < side * side; ++i) {
    const uint64_t hash = hashCombine(element, static_cast<uint64_t>(i));
    const Vec2 jitter(toUnitFloat(hash), toUnitFloat(mixBits(hash)));
    const Vec2 u = (Vec2(i % side, i / side) + jitter) / static_cast<float>(side);
    const auto s = shape_.sampleArea(element, glm::min(u, kOneMinusEpsilon));
    if (!s || !(s->pdf > 0)) continue;
    const double weight = 1 / static_cast<double>(s->pdf);
    sum += weight * static_cast<double>(at(element, s->p, s->n).luminance());
    weights += weight;
  }
  return weights > 0 ? static_cast<float>(sum / weights) : 0.f;
}

void SurfaceEmission::estimateMeans(float otherwise) {
  means_.resize(shape_.elementCount());
  const double perElement = std::sqrt(kPoints / static_cast<double>(means_.size() + 1));
  const int side = std::clamp(static_cast<int>(perElement), kMinSide, kMaxSide);
  parallelFor(means_.size(), 16, [&](size_t begin, size_t end) {
    for (size_t e = begin; e < end; ++e) means_[e] = estimateMean(static_cast<uint32_t>(e), side);
  });
  double sum = 0, areas = 0;
  for (uint32_t e = 0; e < means_.size(); ++e) {
    const auto area = static_cast<double>(shape_.area(e));
    sum += area * static_cast<double>(means_[e]);
    areas += area;
  }
  // Points that all hit black do not prove that nothing is emitted.
  const float mean = sum > 0 ? static_cast<float>(sum / areas) : otherwise;
  for (float& m : means_) m = std::max(m, kFloor * mean);
}

}  // namespace lampyris
