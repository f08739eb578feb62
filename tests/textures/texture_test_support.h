// SPDX-License-Identifier: Apache-2.0
/// Textures made from parameters, as a scene file would make them.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/image.h"
#include "textures/float_registry.h"
#include "textures/spectrum_registry.h"

namespace lampyris::test {

/// Constants, and textures by name.
class NamedTextures final : public TextureResolver {
 public:
  std::map<std::string, const FloatTexture*> floats;
  std::map<std::string, const SpectrumTexture*> spectra;

  TexturedFloat resolve(const FloatInput& i) const override {
    if (i.texture.empty()) return {i.value, nullptr};
    return {0, floats.at(i.texture)};
  }
  TexturedRgb resolve(const RgbInput& i) const override {
    if (i.texture.empty()) return {i.value, nullptr};
    return {Rgb(), spectra.at(i.texture)};
  }
};

/// Owns what parameters point to.
class Parameters {
 public:
  Parameters& add(std::string_view name, ParameterType type, std::vector<float> values) {
    const auto& v = floats_.emplace_back(std::move(values));
    list_.push_back({.name = name, .location = {}, .type = type, .floats = v});
    return *this;
  }
  Parameters& number(std::string_view name, float v) {
    return add(name, ParameterType::Float, {v});
  }
  Parameters& integer(std::string_view name, int v) {
    const auto& stored = integers_.emplace_back(1, v);
    list_.push_back(
        {.name = name, .location = {}, .type = ParameterType::Integer, .integers = stored});
    return *this;
  }
  Parameters& word(std::string_view name, std::string_view text,
                   ParameterType type = ParameterType::String) {
    const auto& stored = words_.emplace_back(1, strings_.emplace_back(text));
    list_.push_back({.name = name, .location = {}, .type = type, .strings = stored});
    return *this;
  }
  ParameterSet set() const { return {list_, {}}; }

 private:
  std::deque<std::vector<float>> floats_;
  std::deque<std::vector<int32_t>> integers_;
  std::deque<std::string> strings_;
  std::deque<std::vector<std::string_view>> words_;
  std::vector<Parameter> list_;
};

struct TextureBench {
  SourceFiles files;
  std::vector<std::string> warnings;
  Diagnostics diagnostics{files, [this](const std::string& w) { warnings.push_back(w); }};
  NamedTextures named;
  ImageCache images;
  Transform textureToWorld;
  std::string folder;

  TextureContext context() {
    return {{diagnostics, [this](const std::string& f) { return folder + "/" + f; }, {1, 2}},
            named,
            images,
            textureToWorld};
  }
  std::unique_ptr<FloatTexture> makeFloat(const std::string& name, const Parameters& p = {}) {
    return floatTextureRegistry().get(name, {}).create(p.set(), context());
  }
  std::unique_ptr<SpectrumTexture> makeSpectrum(const std::string& name, const Parameters& p = {}) {
    return spectrumTextureRegistry().get(name, {}).create(p.set(), context());
  }
};

inline SurfaceInteraction atUv(float u, float v) {
  SurfaceInteraction s;
  s.uv = {u, v};
  return s;
}
inline SurfaceInteraction atPoint(const Vec3& p) {
  SurfaceInteraction s;
  s.p = p;
  return s;
}

}  // namespace lampyris::test
