// SPDX-License-Identifier: Apache-2.0
#include "lightdistributions/brdf_receiver.h"

#include "lightdistributions/brdf_pivot_table.h"

namespace lampyris {

namespace {

/// The least mean of BRDF × cosine, in relation to its mean over the sphere.
constexpr float kFloor = 1e-3f;
/// A cap whose image under every pivot is smaller than this (as a sine) counts as flat: densities
/// within differ by less than a factor (1 + 2 · 0.1)².
constexpr float kFlat = 0.1f;
constexpr float kInvSphere = 0.25f * kInvPi;

}  // namespace

BrdfReceiver::BrdfReceiver(const LightSampleContext& ctx) : p_(ctx.p), emission_(ctx.p, 0) {
  const LightReceiver receiver(ctx);
  if (!ctx.bsdf || !receiver.receives()) return;
  oneSided_ = !receiver.bothSides();
  side_ = receiver.side();
  addShapes(*ctx.bsdf, ctx.wo);
}

void BrdfReceiver::addShapes(const Bsdf& bsdf, const Vec3& wo) {
  if (bsdf.isDiffuse()) return;
  const Vec3 local = bsdf.frame().toLocal(wo);
  up_ = local.z < 0 ? -bsdf.frame().z : bsdf.frame().z;
  for (size_t i = 0; i < bsdf.lobeCount(); ++i) {
    std::array<LobeShape, Lobe::kMaxShapes> shapes;
    const size_t count = bsdf.lobe(i).shapes(local, shapes);
    for (size_t k = 0; k < count; ++k) {
      const LobeShape& shape = shapes[k];
      if (!(shape.albedo > 0 && std::isfinite(shape.albedo))) continue;
      if (shape.kind == LobeShape::Kind::Cosine)
        (shape.transmitted ? diffuseTransmitted_ : diffuseReflected_) += shape.albedo;
      else
        addLobe(shape, wo);
    }
  }
  albedo_ = glossyAlbedo_ + diffuseReflected_ + diffuseTransmitted_;
}

void BrdfReceiver::addLobe(const LobeShape& shape, const Vec3& wo) {
  const PivotLobe lobe = shape.transmitted
                             ? refractionLobe(wo, up_, shape.alpha, shape.eta, shape.albedo)
                             : reflectionLobe(wo, up_, shape.alpha, shape.albedo);
  lobes_[lobeCount_++] = lobe;
  glossyAlbedo_ += lobe.integral();
}

float BrdfReceiver::meanOfCosines(const DirectionCap& cap) const {
  float sum = 0;
  const float height = dot(cap.axis, up_);
  if (diffuseReflected_ > 0) {
    // As in the plain tree: the geometric normal decides whether, the shading normal how much.
    const bool bent = oneSided_ && height < -cap.sine;
    sum += diffuseReflected_ * meanCosine(cap, bent ? -height : height);
  }
  if (diffuseTransmitted_ > 0) sum += diffuseTransmitted_ * meanCosine(cap, -height);
  return sum;
}

BrdfReceiver::Estimate BrdfReceiver::estimate(const LinearLightBVHNode& node) const {
  Estimate e;
  const Vec3 d = node.center() - p_, half = node.halfExtent();
  if (oneSided_ && isBehind(node, d)) return e;
  const double emitted = emission_.importance(node);
  if (!(emitted > 0)) return e;
  const float d2 = dot(d, d), r2 = dot(half, half) * 1.00001f;
  float mean = albedo_ * kInvSphere;
  if (d2 > std::max(r2, FLT_MIN)) {
    const DirectionCap cap(d * (1 / std::sqrt(d2)), r2 / d2);
    float glossy = 0, widest = cap.sine;
    for (size_t i = 0; i < lobeCount_; ++i) glossy += lobes_[i].mean(cap, widest);
    e.flat = widest < kFlat && std::abs(dot(cap.axis, up_)) > cap.sine;
    e.integral = glossy * cap.solidAngle();
    mean = std::max(kFloor * mean, glossy + meanOfCosines(cap));
  } else {
    e.integral = glossyAlbedo_;
    e.inside = true;
  }
  e.importance = emitted * static_cast<double>(mean);
  return e;
}

}  // namespace lampyris
