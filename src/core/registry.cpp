// SPDX-License-Identifier: Apache-2.0
#include "core/registry.h"

#include <fmt/format.h>

namespace lampyris {

std::vector<std::string> RegistryInfo::names() const {
  std::vector<std::string> all;
  for (const PluginInfo* p : plugins()) {
    all.push_back(p->name);
    all.insert(all.end(), p->aliases.begin(), p->aliases.end());
  }
  return all;
}

bool RegistryInfo::knowsParameter(std::string_view name) const {
  for (const PluginInfo* p : plugins())
    if (p->schema.find(name)) return true;
  return false;
}

void checkUnknownParameters(const ParameterSet& set, std::span<const Schema* const> schemas,
                            const RegistryInfo& registry, std::string_view pluginName,
                            Diagnostics& diagnostics) {
  for (const Parameter& p : set.parameters) {
    const ParameterDeclaration* known = nullptr;
    std::vector<std::string> names;
    for (const Schema* s : schemas) {
      if (!known) known = s->find(p.name);
      const auto more = s->names();
      names.insert(names.end(), more.begin(), more.end());
    }
    if (known) {
      if (!known->ignoredBecause.empty())
        diagnostics.warn(p.location,
                         fmt::format("parameter \"{}\" of {} \"{}\" has no effect: {}", p.name,
                                     registry.kind(), pluginName, known->ignoredBecause));
      continue;
    }
    const std::string message =
        fmt::format("unknown parameter \"{}\" for {} \"{}\"", p.name, registry.kind(), pluginName);
    const std::string guess = didYouMean(p.name, names);
    if (!guess.empty() && !registry.knowsParameter(p.name))
      throw SceneError(p.location, message + guess);
    diagnostics.warn(p.location, message + "; it is ignored");
  }
}

}  // namespace lampyris
