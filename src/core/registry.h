// SPDX-License-Identifier: Apache-2.0
/// Registries: the plugins of one kind (shape, material, light distribution …) by name.
///
/// A plugin is one file that defines an entry function `XPlugin xPlugin()` and one line in its
/// kind's registry.cpp. The builder, `help-scene`, the tests and the benchmarks iterate the same
/// registry.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/parameters.h"

namespace lampyris {

/// What `help-scene` needs of a plugin.
struct PluginInfo {
  std::string name;
  std::string summary;  ///< one sentence
  Schema schema;
  std::vector<std::string> aliases;  ///< other names for it in scene files
};

/// A plugin of kind `Base`; `Context` is what it may use while it is created.
template <class Base, class Context>
struct Plugin : PluginInfo {
  std::function<std::unique_ptr<Base>(const ParameterSet&, const Context&)> create;
};

/// Makes a plugin of a function that takes a filled-in parameter struct.
template <class P, class Base, class Context>
Plugin<Base, Context> makePlugin(std::string name, std::string summary,
                                 std::unique_ptr<Base> (*create)(const P&, const Context&),
                                 std::vector<std::string> aliases = {}) {
  Schema schema = Schema::of<P>();
  auto fromSet = [schema, create](const ParameterSet& set, const Context& context) {
    P parameters;
    schema.read(set, &parameters);
    if constexpr (requires { context.location; }) {
      // A file that the directive names and that cannot be read is a fault of the scene.
      try {
        return create(parameters, context);
      } catch (const IoError& e) {
        throw SceneError(context.location, e.what());
      }
    } else {
      return create(parameters, context);
    }
  };
  return {{std::move(name), std::move(summary), std::move(schema), std::move(aliases)}, fromSet};
}

/// The registry's face without types, for help and checks.
class RegistryInfo {
 public:
  explicit RegistryInfo(std::string kind) : kind_(std::move(kind)) {}
  virtual ~RegistryInfo() = default;
  const std::string& kind() const { return kind_; }  ///< e.g. "shape"
  virtual std::vector<const PluginInfo*> plugins() const = 0;
  /// Names and aliases.
  std::vector<std::string> names() const;
  /// True if any plugin of the kind has such a parameter.
  bool knowsParameter(std::string_view name) const;

 private:
  std::string kind_;
};

template <class Base, class Context>
class Registry : public RegistryInfo {
 public:
  using Entry = Plugin<Base, Context>;
  Registry(std::string kind, std::vector<Entry> entries)
      : RegistryInfo(std::move(kind)), entries_(std::move(entries)) {}

  const std::vector<Entry>& entries() const { return entries_; }
  std::vector<const PluginInfo*> plugins() const override {
    std::vector<const PluginInfo*> all;
    for (const Entry& e : entries_) all.push_back(&e);
    return all;
  }
  /// Null if there is none of that name.
  const Entry* find(std::string_view name) const {
    for (const Entry& e : entries_) {
      if (e.name == name) return &e;
      for (const std::string& a : e.aliases)
        if (a == name) return &e;
    }
    return nullptr;
  }
  /// Throws SceneError: `unknown shape "spher"; did you mean "sphere"?`.
  const Entry& get(std::string_view name, SourceLocation where) const {
    if (const Entry* e = find(name)) return *e;
    throw SceneError(
        where, "unknown " + kind() + " \"" + std::string(name) + "\"" + didYouMean(name, names()));
  }

 private:
  std::vector<Entry> entries_;
};

/// Warns of parameters in `set` that none of `schemas` declares, as pbrt-v3 does; a name that no
/// plugin of the kind knows and that is nearly one of the schemas' is an error (a misspelling).
void checkUnknownParameters(const ParameterSet& set, std::span<const Schema* const> schemas,
                            const RegistryInfo& registry, std::string_view pluginName,
                            Diagnostics& diagnostics);

}  // namespace lampyris

// clang-format off
#define LAMPYRIS_DECLARE_ENTRY(plugin) Entry plugin##Plugin();
#define LAMPYRIS_LIST_ENTRY(plugin) plugin##Plugin(),
/// Defines `const Registry<…>& function()` over a list macro `LIST(X)` of plugin names; each name n
/// stands for the entry function nPlugin().
#define LAMPYRIS_REGISTRY(function, kind, RegistryType, LIST)                 \
  namespace lampyris {                                                        \
  using Entry = RegistryType::Entry;                                          \
  LIST(LAMPYRIS_DECLARE_ENTRY)                                                \
  const RegistryType& function() {                                            \
    static const RegistryType registry(kind, {LIST(LAMPYRIS_LIST_ENTRY)});    \
    return registry;                                                          \
  }                                                                           \
  }
// clang-format on
