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

double BrdfReceiver::Weights::total() const {
  double sum = 0;
  for (const float w : importance) sum += static_cast<double>(w);
  return sum;
}

BrdfReceiver::Weights BrdfReceiver::weighEmission(const WideLightBVHNode& node) const {
  const ChildWeights emitted = importances(node, emission_);
  Weights out;
  out.importance = emitted.of;
  out.inside = 0;
  out.flat = 0xff;
  out.unit = sqr(static_cast<double>(node.invExtent)) / static_cast<double>(emitted.unit2);
  return out;
}

// Exact but for caps that the horizon cuts: there the mean is that of the plain tree.
Float8 BrdfReceiver::meanOfCosines(const CapLanes& caps) const {
  const Float8 m = 0.5f + 0.5f * caps.cosine;
  const Float8 height = caps.height(up_), c = height * m;
  const Float8 rest = 0.25f * stdx::max(1 - m * m, Float8(0));
  Float8 size = sqrt(c * c + rest);  // of the mean of |cos|
  where(abs(height) >= caps.sine, size) = abs(c);
  Float8 above = 0.5f * (size + c);
  // As in the plain tree: the geometric normal decides whether, the shading normal how much.
  if (oneSided_) where(height < -caps.sine, above) = -c;
  return kInvPi * (diffuseReflected_ * above + diffuseTransmitted_ * 0.5f * (size - c));
}

namespace {

template <class T>
Float8 load(const WideLightBVHNode::Lanes<T>& lanes) {
  return Float8(lanes.data(), stdx::element_aligned);
}

uint8_t bitsOf(const Float8::mask_type& mask) {
  uint8_t set = 0;
  for (size_t i = 0; i < WideLightBVHNode::kWidth; ++i)
    set = static_cast<uint8_t>(set | (mask[i] ? 1u << i : 0u));
  return set;
}

/// The children's boxes as seen from a point, in the node's units.
struct Boxes {
  Float8 x, y, z;     ///< to the centres
  Float8 hx, hy, hz;  ///< half edges
  Float8 d2, r2;

  Boxes(const WideLightBVHNode& node, const Vec3& from) {
    constexpr float kFar = 1e18f, kStep = 1.f / 65535, kByte = 1.f / 255;
    const Vec3 p = glm::clamp((from - node.origin) * node.invExtent, Vec3(-kFar), Vec3(kFar));
    x = load(node.center[0]) * kStep - p.x;
    y = load(node.center[1]) * kStep - p.y;
    z = load(node.center[2]) * kStep - p.z;
    const auto half = [&](size_t a) {
      const Float8 root = load(node.half[a]) * kByte;
      return 0.5f * root * root;
    };
    hx = half(0), hy = half(1), hz = half(2);
    d2 = x * x + y * y + z * z;
    r2 = (hx * hx + hy * hy + hz * hz) * 1.00001f;
  }
  /// All of the box is on the other side of the plane; some ulps for the rounding of the terms.
  Float8::mask_type isBehind(const Vec3& side) const {
    const Vec3 n = absComponents(side);
    return side.x * x + side.y * y + side.z * z + n.x * hx + n.y * hy + n.z * hz <
           -1e-6f * (n.x * abs(x) + n.y * abs(y) + n.z * abs(z));
  }
  CapLanes caps() const {
    const Float8 inverse = 1 / sqrt(stdx::max(d2, Float8(FLT_MIN)));
    const Float8 sine2 = stdx::min(r2 * inverse * inverse, Float8(1));
    CapLanes c{x * inverse, y * inverse, z * inverse, sqrt(sine2), sqrt(1 - sine2), {}};
    c.versine = sine2 / (1 + c.cosine);
    return c;
  }
};

}  // namespace

[[gnu::flatten]] BrdfReceiver::Weights BrdfReceiver::weigh(const WideLightBVHNode& node) const {
  Weights out = weighEmission(node);
  const Boxes boxes(node, p_);
  const CapLanes caps = boxes.caps();
  const auto outside = boxes.d2 > stdx::max(boxes.r2, Float8(FLT_MIN));
  Float8 glossy = 0, widest = caps.sine;
  for (size_t i = 0; i < lobeCount_; ++i) glossy += PivotLobeLanes::mean(lobes_[i], caps, widest);

  Float8 mean = glossy;
  if (diffuseReflected_ > 0 || diffuseTransmitted_ > 0) mean += meanOfCosines(caps);
  const float everywhere = albedo_ * kInvSphere;
  mean = stdx::max(mean, Float8(kFloor * everywhere));
  where(!outside, mean) = everywhere;
  if (oneSided_) where(boxes.isBehind(side_), mean) = 0;
  Float8 weights(out.importance.data(), stdx::vector_aligned);
  weights *= mean;
  where(!(weights > 0), weights) = 0;  // not a number: the point isn't one either
  weights.copy_to(out.importance.data(), stdx::vector_aligned);

  Float8 integral = glossy * (2 * kPi) * caps.versine;
  where(!outside, integral) = glossyAlbedo_;
  integral.copy_to(out.integral.data(), stdx::vector_aligned);
  out.inside = bitsOf(!outside);
  out.flat = bitsOf(outside && widest < kFlat && abs(caps.height(up_)) > caps.sine);
  return out;
}

}  // namespace lampyris
