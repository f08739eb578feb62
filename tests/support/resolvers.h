// SPDX-License-Identifier: Apache-2.0
/// Textures and materials by name, and a context to build plugins in, for tests.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/material.h"
#include "base/texture.h"

namespace lampyris::test {

/// A texture that is a function of the interaction.
template <class T>
class FunctionTexture final : public Texture<T> {
 public:
  explicit FunctionTexture(std::function<T(const SurfaceInteraction&)> f) : f_(std::move(f)) {}
  T evaluate(const SurfaceInteraction& at) const override { return f_(at); }

 private:
  std::function<T(const SurfaceInteraction&)> f_;
};

class TestTextures final : public TextureResolver {
 public:
  void addFloat(const std::string& name, std::function<float(const SurfaceInteraction&)> f) {
    floats_[name] = std::make_unique<FunctionTexture<float>>(std::move(f));
  }
  void addRgb(const std::string& name, std::function<Rgb(const SurfaceInteraction&)> f) {
    rgbs_[name] = std::make_unique<FunctionTexture<Rgb>>(std::move(f));
  }
  TexturedFloat resolve(const FloatInput& in) const override { return find(floats_, in); }
  TexturedRgb resolve(const RgbInput& in) const override { return find(rgbs_, in); }

 private:
  template <class T>
  using Named = std::map<std::string, std::unique_ptr<Texture<T>>>;
  template <class T, class Input>
  static Textured<T> find(const Named<T>& map, const Input& in) {
    Textured<T> out{in.value};
    if (in.texture.empty()) return out;
    const auto it = map.find(in.texture);
    if (it == map.end()) throw SceneError(in.location, "unknown texture \"" + in.texture + "\"");
    out.texture = it->second.get();
    return out;
  }
  Named<float> floats_;
  Named<Rgb> rgbs_;
};

/// Does not own the materials.
class TestMaterials final : public MaterialResolver {
 public:
  void add(const std::string& name, const Material* m) { materials_[name] = m; }
  const Material* resolve(const std::string& name, SourceLocation where) const override {
    const auto it = materials_.find(name);
    if (it == materials_.end()) throw SceneError(where, "unknown material \"" + name + "\"");
    return it->second;
  }

 private:
  std::map<std::string, const Material*> materials_;
};

/// A ParameterSet from text, as `-D name=value` reads it: {{"Kd", "0.5 0.5 0.5"}}. A value "@name"
/// is the texture of that name.
class TestParameters {
 public:
  using List = std::vector<std::pair<std::string, std::string>>;
  TestParameters(const Schema& schema, const List& list) {
    for (const auto& [name, value] : list) {
      const ParameterDeclaration* d = schema.find(name);
      if (!d) throw SceneError("no parameter \"" + name + "\"");
      if (value.starts_with("@")) {
        auto p = std::make_unique<OwnedParameter>();
        p->name = name;
        p->strings = {value.substr(1)};
        p->views = {p->strings[0]};
        p->parameter.name = p->name;
        p->parameter.type = ParameterType::Texture;
        p->parameter.strings = p->views;
        owned_.push_back(std::move(p));
      } else {
        owned_.push_back(parseOverride(*d, value));
      }
      parameters_.push_back(owned_.back()->parameter);
    }
  }
  ParameterSet set() const { return {parameters_, {}}; }

 private:
  std::vector<std::unique_ptr<OwnedParameter>> owned_;
  std::vector<Parameter> parameters_;
};

/// What a BuildContext refers to. Warnings are collected.
struct TestBuild {
  SourceFiles files;
  std::vector<std::string> warnings;
  Diagnostics diagnostics{files, [this](const std::string& text) { warnings.push_back(text); }};
  TestTextures textures;
  TestMaterials materials;

  BuildContext base() {
    return {diagnostics, [](const std::string& file) { return file; }, {}};
  }
  MaterialContext materialContext() { return {base(), textures, materials}; }
};

}  // namespace lampyris::test
