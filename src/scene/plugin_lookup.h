// SPDX-License-Identifier: Apache-2.0
/// Finds plugins by the names that scene files use.
#pragma once

#include <span>

#include "core/registry.h"

namespace lampyris {

/// Throws the SceneError for a name that the registry lacks: a feature of pbrt-v3 that is not
/// rendered yet, or an unknown name with the nearest known one.
[[noreturn]] void failUnknownPlugin(const RegistryInfo& registry, std::string_view name,
                                    SourceLocation where);

template <class R>
const typename R::Entry& findPlugin(const R& registry, std::string_view name,
                                    SourceLocation where) {
  if (const auto* entry = registry.find(name)) return *entry;
  failUnknownPlugin(registry, name, where);
}

/// findPlugin() that remembers the last answer: scenes name the same plugin many times in a row.
template <class R>
class PluginFinder {
 public:
  explicit PluginFinder(const R& registry) : registry_(registry) {}
  const typename R::Entry& find(std::string_view name, SourceLocation where) {
    if (!last_ || name != lastName_) {
      last_ = &findPlugin(registry_, name, where);
      lastName_ = name;
    }
    return *last_;
  }

 private:
  const R& registry_;
  const typename R::Entry* last_ = nullptr;
  std::string_view lastName_;
};

/// checkUnknownParameters(), cheap where all parameters are known.
void checkParameters(const ParameterSet& set, std::span<const Schema* const> schemas,
                     const RegistryInfo& registry, std::string_view pluginName,
                     Diagnostics& diagnostics);

/// The parameter that is read into `declaration`, by name or alias; null if there is none.
const Parameter* findDeclared(const ParameterSet& set, const ParameterDeclaration& declaration);

}  // namespace lampyris
