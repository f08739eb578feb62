// SPDX-License-Identifier: Apache-2.0
#include "scene/appearance_builder.h"

#include <fmt/format.h>

#include <utility>

#include "materials/registry.h"
#include "scene/plugin_lookup.h"
#include "scene/tokenizer.h"
#include "textures/float_registry.h"
#include "textures/spectrum_registry.h"

namespace lampyris {

namespace {

[[noreturn]] void failName(const char* kind, const NameIndex& names, std::string_view name,
                           SourceLocation where, const char* hint = "") {
  if (names.knows(name))
    throw SceneError(where, fmt::format("{} {} is not defined here: it is defined later, or in an "
                                        "AttributeBegin block that has ended",
                                        kind, inQuotes(name)));
  throw SceneError(where, fmt::format("unknown {} {}{}{}", kind, inQuotes(name), hint,
                                      *hint ? "" : didYouMean(name, names.names())));
}

/// A few textures that each name another one twice would be evaluated without end.
void checkEvaluations(size_t evaluations, SourceLocation where) {
  constexpr size_t kMost = 10'000;
  if (evaluations > kMost)
    throw SceneError(where,
                     fmt::format("one value of this texture takes {} values of textures that "
                                 "it refers to, more than {}",
                                 evaluations - 1, kMost));
}

/// A material's parameters that a shape may not replace, for they are the shape's own.
bool belongsToShape(std::string_view parameter) {
  return parameter == "alpha" || parameter == "shadowalpha";
}

}  // namespace

bool isNoMaterial(const MaterialDefinition& material) {
  return material.plugin.name.empty() || material.plugin.name == "none";
}

/// Counts how deep definitions refer to each other; each level takes room on the stack.
class AppearanceBuilder::DepthGuard {
 public:
  DepthGuard(int& depth, SourceLocation where) : depth_(depth) {
    constexpr int kDeepest = 500;
    if (++depth_ > kDeepest) {
      --depth_;
      throw SceneError(where, fmt::format("textures and materials refer to each other over more "
                                          "than {} levels",
                                          kDeepest));
    }
  }
  ~DepthGuard() { --depth_; }
  DepthGuard(const DepthGuard&) = delete;
  DepthGuard& operator=(const DepthGuard&) = delete;

 private:
  int& depth_;
};

AppearanceBuilder::AppearanceBuilder(BuildState& state)
    : state_(state),
      floatTextures_(state.description.textures.size()),
      spectrumTextures_(state.description.textures.size()),
      materials_(state.description.materials.size()) {}

TexturedFloat AppearanceBuilder::Resolver::resolve(const FloatInput& input) const {
  if (input.texture.empty()) return {input.value, nullptr};
  return {0, builder_.floatTexture(input.texture, order_, input.location)};
}

TexturedRgb AppearanceBuilder::Resolver::resolve(const RgbInput& input) const {
  if (input.texture.empty()) return {input.value, nullptr};
  return {Rgb(), builder_.spectrumTexture(input.texture, order_, input.location)};
}

const Material* AppearanceBuilder::Resolver::resolve(const std::string& name,
                                                     SourceLocation where) const {
  const NameIndex& names = builder_.state_.description.materialNames;
  const uint32_t index = names.find(name, order_);
  if (index == kNone) failName("named material", names, name, where);
  return builder_.material(index);
}

template <class R, class T>
T* AppearanceBuilder::buildTexture(const R& registry, uint32_t index,
                                   std::vector<std::unique_ptr<T>>& owner,
                                   std::vector<Built<T>>& built) {
  const std::lock_guard lock(mutex_);
  Built<T>& memo = built[index];
  if (memo.done) {
    evaluations_ += memo.evaluations;
    return memo.object;
  }
  const TextureDefinition& d = state_.description.textures[index];
  const SourceLocation where = d.plugin.parameters.location;
  const DepthGuard guard(depth_, where);
  const auto& plugin = findPlugin(registry, d.plugin.name, where);
  const ParameterSet set = state_.spectra.resolve(d.plugin.parameters);
  const Schema* const schemas[] = {&plugin.schema};
  checkParameters(set, schemas, registry, plugin.name, state_.diagnostics);
  const Resolver resolver(*this, d.order);
  const size_t outer = std::exchange(evaluations_, 1);
  auto texture = plugin.create(
      set, {state_.context(where), resolver, state_.images, state_.transform(d.transform, where)});
  checkEvaluations(evaluations_, where);
  memo = {owner.emplace_back(std::move(texture)).get(), true, evaluations_};
  evaluations_ += outer;
  return memo.object;
}

const FloatTexture* AppearanceBuilder::floatTexture(const std::string& name, uint32_t order,
                                                    SourceLocation where) {
  const Description& d = state_.description;
  const uint32_t index = d.floatTextureNames.find(name, order);
  if (index == kNone)
    failName(
        "float texture", d.floatTextureNames, name, where,
        d.spectrumTextureNames.knows(name) ? ": there is a spectrum texture of that name" : "");
  return buildTexture(floatTextureRegistry(), index, state_.job.scene.floatTextures,
                      floatTextures_);
}

const SpectrumTexture* AppearanceBuilder::spectrumTexture(const std::string& name, uint32_t order,
                                                          SourceLocation where) {
  const Description& d = state_.description;
  const uint32_t index = d.spectrumTextureNames.find(name, order);
  if (index == kNone)
    failName("spectrum texture", d.spectrumTextureNames, name, where,
             d.floatTextureNames.knows(name) ? ": there is a float texture of that name" : "");
  return buildTexture(spectrumTextureRegistry(), index, state_.job.scene.spectrumTextures,
                      spectrumTextures_);
}

const Material* AppearanceBuilder::create(const MaterialRegistry::Entry& plugin,
                                          const ParameterSet& set, uint32_t order) {
  const Resolver resolver(*this, order);
  auto material = plugin.create(set, {state_.context(set.location), resolver, resolver});
  return state_.job.scene.materials.emplace_back(std::move(material)).get();
}

const Material* AppearanceBuilder::material(uint32_t index) {
  const std::lock_guard lock(mutex_);
  auto& memo = materials_[index];
  if (memo.done) return memo.object;
  const MaterialDefinition& d = state_.description.materials[index];
  const SourceLocation where = d.plugin.parameters.location;
  if (!isNoMaterial(d)) {
    const DepthGuard guard(depth_, where);
    const auto& plugin = findPlugin(materialRegistry(), d.plugin.name, where);
    const ParameterSet set = state_.spectra.resolve(d.plugin.parameters);
    const Schema* const schemas[] = {&plugin.schema};
    checkParameters(set, schemas, materialRegistry(), plugin.name, state_.diagnostics);
    memo.object = create(plugin, set, d.order);
  }
  memo.done = true;
  return memo.object;
}

const Schema* AppearanceBuilder::materialSchema(const ShapeDescription& shape) const {
  const MaterialDefinition& d = state_.description.materials[shape.material];
  if (isNoMaterial(d)) return nullptr;
  return &findPlugin(materialRegistry(), d.plugin.name, d.plugin.parameters.location).schema;
}

const Material* AppearanceBuilder::materialOf(const ShapeDescription& shape) {
  const MaterialDefinition& d = state_.description.materials[shape.material];
  const Schema* schema = materialSchema(shape);
  if (!schema) return nullptr;
  const ParameterSet own = state_.spectra.resolve(shape.plugin.parameters);
  std::vector<Parameter> replaced;
  for (const Parameter& p : own.parameters)
    if (schema->find(p.name) && !belongsToShape(p.name)) replaced.push_back(p);
  if (replaced.empty()) return material(shape.material);

  const std::lock_guard lock(mutex_);
  const auto& plugin = findPlugin(materialRegistry(), d.plugin.name, d.plugin.parameters.location);
  const ParameterSet base = state_.spectra.resolve(d.plugin.parameters);
  const Schema* const schemas[] = {schema};
  checkParameters(base, schemas, materialRegistry(), plugin.name, state_.diagnostics);
  std::vector<Parameter> merged(base.parameters.begin(), base.parameters.end());
  merged.insert(merged.end(), replaced.begin(), replaced.end());
  return create(plugin, {merged, base.location.known() ? base.location : own.location},
                shape.order);
}

}  // namespace lampyris
