// SPDX-License-Identifier: Apache-2.0
#include "scene/plugin_lookup.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/tokenizer.h"

namespace lampyris {

namespace {

bool allKnown(const ParameterSet& set, std::span<const Schema* const> schemas) {
  return std::all_of(set.parameters.begin(), set.parameters.end(), [&](const Parameter& p) {
    return std::any_of(schemas.begin(), schemas.end(), [&p](const Schema* s) {
      const ParameterDeclaration* d = s->find(p.name);
      return d && d->ignoredBecause.empty();
    });
  });
}

}  // namespace

void failUnknownPlugin(const RegistryInfo& registry, std::string_view name, SourceLocation where) {
  if (name == "ptex" && registry.kind().ends_with("texture"))
    throw SceneError(
        where,
        "\"ptex\" is a pbrt-v3 texture that Lampyris cannot read: no Debian package has "
        "the Ptex library; bake the texture to an image and use \"imagemap\"");
  throw SceneError(where, fmt::format("unknown {} {}{}", registry.kind(), inQuotes(name),
                                      didYouMean(name.substr(0, 64), registry.names())));
}

void checkParameters(const ParameterSet& set, std::span<const Schema* const> schemas,
                     const RegistryInfo& registry, std::string_view pluginName,
                     Diagnostics& diagnostics) {
  if (!allKnown(set, schemas))
    checkUnknownParameters(set, schemas, registry, pluginName, diagnostics);
}

const Parameter* findDeclared(const ParameterSet& set, const ParameterDeclaration& declaration) {
  for (size_t i = set.parameters.size(); i-- > 0;)
    if (declaration.matches(set.parameters[i].name)) return &set.parameters[i];
  return nullptr;
}

}  // namespace lampyris
