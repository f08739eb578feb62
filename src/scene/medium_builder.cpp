// SPDX-License-Identifier: Apache-2.0
#include "scene/medium_builder.h"

#include <fmt/format.h>

#include "media/registry.h"
#include "scene/plugin_lookup.h"
#include "scene/tokenizer.h"

namespace lampyris {

MediumInterface MediumBuilder::interfaceOf(uint32_t index) {
  if (index == kNone) return {};
  const MediumInterfaceDescription& d = state_.description.mediumInterfaces[index];
  return {medium(d.inside, d), medium(d.outside, d)};
}

const Medium* MediumBuilder::medium(std::string_view name, const MediumInterfaceDescription& use) {
  if (name.empty()) return nullptr;
  const auto& all = state_.description.media;
  // Of several definitions the last one before the use counts.
  for (size_t i = all.size(); i-- > 0;) {
    if (all[i].name != name || all[i].order >= use.order) continue;
    if (!built_[i]) built_[i] = create(all[i]);
    return built_[i];
  }
  std::vector<std::string> names;
  names.reserve(all.size());
  for (const MediumDefinition& m : all) names.emplace_back(m.name);
  throw SceneError(use.location, fmt::format("medium {} is not defined before its use{}",
                                             inQuotes(name), didYouMean(name, names)));
}

const Medium* MediumBuilder::create(const MediumDefinition& definition) {
  const MediumRegistry& registry = mediumRegistry();
  const ParameterSet set = state_.spectra.resolve(definition.plugin.parameters);
  const auto& plugin = findPlugin(registry, definition.plugin.name, set.location);
  const Schema* const schemas[] = {&plugin.schema};
  checkParameters(set, schemas, registry, plugin.name, state_.diagnostics);
  const MediumContext context{state_.context(set.location),
                              state_.transform(definition.transform, set.location)};
  return state_.job.scene.media.emplace_back(plugin.create(set, context)).get();
}

}  // namespace lampyris
