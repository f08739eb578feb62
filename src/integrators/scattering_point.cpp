// SPDX-License-Identifier: Apache-2.0
#include "integrators/scattering_point.h"

#include <algorithm>
#include <cmath>

#include "core/math.h"

namespace lampyris {

namespace {

/// Directions weighed at a time, in loops that compilers turn into vector instructions.
constexpr size_t kBatch = 16;

struct ShapeList {
  std::array<LobeShape, Bsdf::kMaxLobes * Lobe::kMaxShapes> shapes;
  size_t count = 0;
};

/// False where a glossy lobe says nothing of its shape, or refracts.
bool collectShapes(const Bsdf& bsdf, const Vec3& wo, ShapeList& list) {
  for (size_t i = 0; i < bsdf.lobeCount(); ++i) {
    const Lobe& lobe = bsdf.lobe(i);
    const std::span<LobeShape, Lobe::kMaxShapes> own(&list.shapes[list.count], Lobe::kMaxShapes);
    const auto told = own.first(lobe.shapes(wo, own));
    const auto isFacets = [](const LobeShape& s) { return s.kind == LobeShape::Kind::Facets; };
    const auto refracts = [&](const LobeShape& s) { return isFacets(s) && s.transmitted; };
    if ((lobe.flags & kGlossy) && std::ranges::none_of(told, isFacets)) return false;
    if (std::ranges::any_of(told, refracts)) return false;
    list.count += told.size();
  }
  return true;
}

/// Of directions, with respect to the shading normal on wo's side.
struct Batch {
  std::array<float, kBatch> z, half2;  ///< cosines; those between the normal and (wo + wi), squared
};

void addCosine(const LobeShape& s, const Batch& b, std::span<float> weights) {
  const float perCosine = s.albedo * kInvPi * (s.transmitted ? -1.f : 1.f);
  for (size_t i = 0; i < weights.size(); ++i) weights[i] += std::max(0.f, perCosine * b.z[i]);
}

/// As MicrofacetReflection, for facets that lose no light but by the factor s.albedo.
void addFacets(const LobeShape& s, float zo, const Batch& b, std::span<float> weights) {
  const float a2 = s.alpha * s.alpha;
  const auto stretched = [a2](float z) { return std::sqrt(z * z + a2 * (1 - z * z)); };
  const float so = stretched(zo), factor = 0.5f * kInvPi * s.albedo * a2;
  for (size_t i = 0; i < weights.size(); ++i) {
    const float z = std::max(0.f, b.z[i]);
    const float e = std::max(a2, 1 + (a2 - 1) * b.half2[i]);
    weights[i] += factor * z / (e * e * (so * z + stretched(z) * zo));
  }
}

}  // namespace

bool ScatteringPoint::weighByShapes(std::span<const Vec3> wi, std::span<float> weights) const {
  const Bsdf& bsdf = *at_.bsdf;
  const Vec3 wo = bsdf.frame().toLocal(at_.wo);
  ShapeList list;
  if (wo.z == 0 || !collectShapes(bsdf, wo, list)) return false;
  const Vec3 n = faceForward(bsdf.frame().z, at_.wo);
  const float zo = std::abs(wo.z);
  std::ranges::fill(weights, 0.f);
  for (size_t first = 0; first < wi.size(); first += kBatch) {
    const size_t count = std::min(kBatch, wi.size() - first);
    Batch b;
    for (size_t i = 0; i < count; ++i) {
      const Vec3& w = wi[first + i];
      constexpr float kOpposite = 1e-6f;
      b.z[i] = dot(w, n);
      b.half2[i] = sqr(zo + b.z[i]) / std::max(2 + 2 * dot(w, at_.wo), kOpposite);
    }
    for (const LobeShape& s : std::span(list.shapes).first(list.count)) {
      const auto part = weights.subspan(first, count);
      if (s.kind == LobeShape::Kind::Cosine)
        addCosine(s, b, part);
      else
        addFacets(s, zo, b, part);
    }
  }
  return true;
}

void ScatteringPoint::weigh(std::span<const Vec3> wi, std::span<float> weights) const {
  if (at_.bsdf && weighByShapes(wi, weights)) return;
  for (size_t i = 0; i < wi.size(); ++i) weights[i] = at_.scattered(wi[i]).luminance();
}

float ScatteringPoint::even() const {
  const Bsdf* const bsdf = at_.bsdf;
  if (!bsdf) return at_.phase->isIsotropic() ? at_.phase->p(at_.wo, at_.wo) : -1;
  if (!bsdf->isDiffuse() || bsdf->transmits()) return -1;
  return bsdf->f(at_.wo, faceForward(bsdf->frame().z, at_.wo)).luminance();
}

}  // namespace lampyris
