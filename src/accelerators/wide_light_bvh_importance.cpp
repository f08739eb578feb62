// SPDX-License-Identifier: Apache-2.0
// Written with the vectors of the C++ Parallelism TS v2 (ISO/IEC TS 19570:2018, §9).
#include "accelerators/wide_light_bvh_importance.h"

#include <experimental/simd>

namespace lampyris {

namespace {

namespace stdx = std::experimental;
using Float8 = stdx::simd<float, stdx::simd_abi::deduce_t<float, WideLightBVHNode::kWidth>>;

using Bits8 = stdx::rebind_simd_t<uint32_t, Float8>;

template <class T>
Float8 load(const WideLightBVHNode::Lanes<T>& lanes) {
  return Float8(lanes.data(), stdx::element_aligned);
}

struct Vec3x8 {
  Float8 x, y, z;
};
Float8 dot(const Vec3x8& a, const Vec3x8& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Float8 dot(const Vec3& a, const Vec3x8& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// In the node's units, of the order of what rounding its positions does to d².
constexpr float kLeastD2 = 1e-12f;

/// True in the lanes that are in the set.
Float8::mask_type lanesOf(uint8_t set) {
  using Int8 = stdx::rebind_simd_t<int32_t, Float8>;
  const Int8 bits([](auto i) { return 1 << i; });
  return stdx::static_simd_cast<Float8>(bits & set) != 0;
}

/// Position of the children as a receiver sees them, in the node's units.
struct Geometry {
  Vec3 receiver;
  Vec3x8 toCenter, half;
  Float8 d2, r2;

  Geometry(const WideLightBVHNode& node, const Vec3& p) {
    // Beyond this, squares overflow and directions no longer change.
    constexpr float kFar = 1e18f;
    receiver = glm::clamp((p - node.origin) * node.invExtent, Vec3(-kFar), Vec3(kFar));
    constexpr float kStep = 1.f / 65535, kByte = 1.f / 255;
    toCenter = {load(node.center[0]) * kStep - receiver.x,
                load(node.center[1]) * kStep - receiver.y,
                load(node.center[2]) * kStep - receiver.z};
    const auto unpackHalf = [&](size_t a) {
      const Float8 root = load(node.half[a]) * kByte;
      return 0.5f * root * root;
    };
    half = {unpackHalf(0), unpackHalf(1), unpackHalf(2)};
    d2 = dot(toCenter, toCenter);
    r2 = dot(half, half) * 1.00001f;  // so that rounding makes no angle θb too small
  }
};

/// How far `d` reaches beyond a box with half edge `half`.
[[gnu::always_inline]] inline Float8 beyond(const Float8& d, const Float8& half) {
  return stdx::max(abs(d) - half, Float8(0));
}

/// The square of LightReceiver::meanSquaredDistance(), relative to `unit2` squared: neither end of
/// the floats is near, however far the receiver is.
[[gnu::always_inline]] inline Float8 meanDistance4(const Geometry& g, float unit2) {
  const Vec3x8 toBox{beyond(g.toCenter.x, g.half.x), beyond(g.toCenter.y, g.half.y),
                     beyond(g.toCenter.z, g.half.z)};
  const Float8 least = stdx::max(g.r2 * LightReceiver::kNearest2, Float8(kLeastD2));
  const float scale = 1 / unit2;
  return (stdx::max(dot(toBox, toBox), least) * scale) * (stdx::max(g.d2 + g.r2, least) * scale);
}

/// The angle θb that the bounding spheres subtend; within one lights may lie in any direction.
struct Uncertainty {
  Float8 cosine, sine;
  Uncertainty(const Geometry& g, const Float8& invLength2) {
    const Float8 sine2 = stdx::min(g.r2 * invLength2, Float8(1));
    sine = sqrt(sine2);
    cosine = sqrt(1 - sine2);
    where(g.d2 <= g.r2, cosine) = 0;
  }
};

/// meanCosine() and meanAbsCosine().
struct MeanCosine {
  Float8 clamped, absolute;
  MeanCosine(const Float8& cosine, const Float8& m) {
    const Float8 c = cosine * m;
    absolute = sqrt(c * c + 0.25f * stdx::max(1 - m * m, Float8(0)));
    clamped = 0.5f * (c + absolute);
  }
};
Float8 capMeans(const Float8& cosine) { return 0.5f + 0.5f * cosine; }

/// Lights of a cluster are alike but for their intensity where its radius is at most this part of
/// the distance, and the sine of how far angles differ at most this part of their cosine.
constexpr float kAlikeDistance = 0.2f, kAlikeCosine = 0.5f;

/// Sets `alike` to 0 where a child's lights differ in it.
[[gnu::always_inline]] inline Float8 receiverFactor(const LightReceiver& at, const Geometry& g,
                                                    const Float8& invLength, const Uncertainty& b,
                                                    Float8& alike) {
  Float8 cosine =
      stdx::clamp(dot(at.shadingNormal(), g.toCenter) * invLength, Float8(-1), Float8(1));
  where(b.sine > kAlikeCosine * (at.bothSides() ? abs(cosine) : cosine), alike) = 0;
  if (at.tilt() > 0) where(cosine < 0, cosine) = stdx::min(-cosine, Float8(at.tilt()));
  const MeanCosine mean(cosine, capMeans(b.cosine));
  return stdx::max(at.bothSides() ? mean.absolute : mean.clamped, Float8(LightReceiver::kFloor));
}

/// 0 where nothing is emitted towards the receiver. Sets `alike` to 0 where a child's lights differ
/// in it.
[[gnu::always_inline]] inline Float8 emissionFactor(const WideLightBVHNode& node, const Geometry& g,
                                                    const Float8& invLength, const Uncertainty& b,
                                                    Float8& alike) {
  const Vec3x8 axis{load(node.axis[0]), load(node.axis[1]), load(node.axis[2])};
  // Lanes without an axis divide by zero; they are overwritten below.
  Float8 cosine = dot(axis, g.toCenter) * invLength / -sqrt(dot(axis, axis));
  const auto twoSided = lanesOf(node.twoSided);
  where(twoSided, cosine) = abs(cosine);
  const Float8 sine = sqrt(stdx::max(1 - cosine * cosine, Float8(0)));
  const Float8 h = load(node.halfSineO) * (1.f / 255);
  const Float8 cosO = 1 - 2 * h * h, sinO = 2 * h * sqrt(stdx::max(1 - h * h, Float8(0)));
  const Float8 cosE = load(node.cosineE) * (1.f / 127) - 1;

  const MeanCosine mean(cosine, capMeans(cosO) * capMeans(b.cosine));
  Float8 factor = mean.clamped;
  where(twoSided, factor) = mean.absolute;
  Float8 least = LightReceiver::kFloor;
  where(cosE < -1e-3f, least) = LightReceiver::kWideEmissionFloor;
  factor = stdx::max(factor, least);

  // Beyond θo by x, by x − θb at least: nothing is emitted where that is more than θe.
  const Float8 cosX = cosine * cosO + sine * sinO, sineX = sine * cosO - cosine * sinO;
  const auto beyond = cosine < cosO && cosX < b.cosine && b.cosine > 0;
  where(beyond && cosX * b.cosine + sineX * b.sine < cosE - 1e-4f, factor) = 0;
  const auto allNormals = lanesOf(node.allNormals);
  where(allNormals, factor) = 1;
  // Of θo + θb; with θ more than θe, some of the lights send nothing.
  const Float8 sineS = sinO * b.cosine + cosO * b.sine, cosS = cosO * b.cosine - sinO * b.sine;
  const auto differ =
      cosO < 0 || sineS > kAlikeCosine * cosine || cosine * cosS - sine * sineS < cosE;
  where(!allNormals && differ, alike) = 0;
  return factor;
}

}  // namespace

// The vectors' operators are functions to the compiler, some of them too large to be inlined
// unasked.
[[gnu::flatten]] ChildWeights importances(const WideLightBVHNode& node, const LightReceiver& at) {
  const Geometry g(node, at.position());
  // Roots and quotients take most of the time: side by side rather than one after the other.
  const Float8 invLength2 = 1 / stdx::max(g.d2, stdx::max(g.r2, Float8(kLeastD2)));
  const Float8 invLength = sqrt(invLength2);
  const Uncertainty uncertainty(g, invLength2);
  Float8 factor = 1, alike = 1;
  where(uncertainty.sine > kAlikeDistance, alike) = 0;
  if (at.hasSurface()) factor = receiverFactor(at, g, invLength, uncertainty, alike);
  if (node.allNormals != 0xff) factor *= emissionFactor(node, g, invLength, uncertainty, alike);
  if (!at.bothSides()) {
    // The box's corner furthest in front; some ulps for the rounding of the terms.
    const Vec3 n = absComponents(at.side());
    const Float8 size = n.x * abs(g.toCenter.x) + n.y * abs(g.toCenter.y) + n.z * abs(g.toCenter.z);
    const Float8 height = dot(at.side(), g.toCenter), reach = dot(n, g.half);
    where(height + reach < -1e-6f * size, factor) = 0;
    where(height < reach, alike) = 0;
  }
  ChildWeights out;
  alike.copy_to(out.alike.data(), stdx::vector_aligned);
  out.unit2 = std::max(1.f, glm::dot(g.receiver, g.receiver));
  // Intensities are the upper halves of floats: moved there, they are floats.
  const Bits8 halves(node.intensity.data(), stdx::element_aligned);
  const auto intensity = std::bit_cast<Float8>(halves << 16);
  Float8 weights = (intensity / sqrt(meanDistance4(g, out.unit2))) * factor;
  where(!(weights > 0), weights) = 0;  // not a number: the point isn't one either
  weights.copy_to(out.of.data(), stdx::vector_aligned);

  // By twos and fours, which waits less than one after the other does.
  std::array<double, 8> w;
  for (size_t i = 0; i < w.size(); ++i) w[i] = static_cast<double>(out.of[i]);
  const double w01 = w[0] + w[1], w23 = w[2] + w[3], w03 = w01 + w23;
  const double w45 = w[4] + w[5], w67 = w[6] + w[7], w05 = w03 + w45;
  out.upTo = {w[0], w01, w01 + w[2], w03, w03 + w[4], w05, w05 + w[6], w05 + w67};
  return out;
}

[[gnu::flatten]] uint8_t nearChildren(const WideLightBVHNode& node, const Vec3& p, float ratio) {
  const Geometry g(node, p);
  const auto isNear = g.r2 >= ratio * (g.d2 - g.r2);
  uint8_t set = 0;
  for (size_t i = 0; i < WideLightBVHNode::kWidth; ++i)
    set = static_cast<uint8_t>(set | (isNear[i] ? 1u << i : 0u));
  return set;
}

}  // namespace lampyris
