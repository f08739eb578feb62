// SPDX-License-Identifier: Apache-2.0
/// What the materials have in common: bump maps, inputs that may be textures, mixing.
#pragma once

#include <memory>
#include <optional>

#include "base/material.h"

namespace lampyris {

/// Parameters of every material but "mix".
struct SurfaceParameters {
  std::optional<FloatInput> bumpMap;
  void declareSurface(Declaration& d) {
    d.add("bumpmap", bumpMap, "Displacement along the normal that bends the shading normal.").any();
  }
};

class SurfaceMaterial : public Material {
 public:
  void evaluate(SurfaceInteraction& at, Bsdf& bsdf) const final {
    bend(at);
    bsdf.reset(at);
    addLobes(at, bsdf);
  }
  SurfaceDetail detail() const override {
    return bumps_ ? SurfaceDetail::Full : SurfaceDetail::Basic;
  }
  bool wantsDifferentials() const override { return textured_; }

  /// Bends the shading frame of `at` by the bump map, if there is one.
  virtual void bend(SurfaceInteraction& at) const;
  /// Adds the lobes at a point, in whatever frame `bsdf` has.
  virtual void addLobes(const SurfaceInteraction& at, Bsdf& bsdf) const = 0;
  /// The most lobes that addLobes() can add.
  virtual size_t maxLobes() const { return 1; }

 protected:
  SurfaceMaterial() = default;
  SurfaceMaterial(const SurfaceParameters& p, const MaterialContext& context);

  /// For members' initialisers: resolves a parameter and notes whether it is a texture.
  template <class Input>
  auto input(const MaterialContext& context, const Input& in) {
    const auto resolved = context.textures.resolve(in);
    textured_ |= !resolved.isConstant();
    return resolved;
  }
  /// An optional parameter, or `otherwise`.
  TexturedFloat input(const MaterialContext& context, const std::optional<FloatInput>& in,
                      const TexturedFloat& otherwise) {
    return in ? input(context, *in) : otherwise;
  }

 private:
  TexturedFloat bump_;
  bool bumps_ = false, textured_ = false;
};

/// A reflectance: pbrt-v3 clamps below 0. What is no number counts as 0; a bound far above any
/// meaning keeps products finite.
inline Rgb reflectance(const Rgb& c) {
  // With the constant first std::max and std::min drop a NaN.
  const auto fix = [](float v) { return std::min(1e6f, std::max(0.f, v)); };
  return {fix(c.r), fix(c.g), fix(c.b)};
}
/// An index of refraction in relation to another: constants are range-checked, textures end here.
inline constexpr double kMinEta = 1e-2, kMaxEta = 1e2;
inline float refractiveIndex(float eta) {
  return eta > 0 ? std::clamp(eta, static_cast<float>(kMinEta), static_cast<float>(kMaxEta)) : 1.f;
}

/// For makePlugin.
template <class M, class Parameters>
std::unique_ptr<Material> createMaterial(const Parameters& p, const MaterialContext& context) {
  return std::make_unique<M>(p, context);
}

}  // namespace lampyris
