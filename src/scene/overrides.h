// SPDX-License-Identifier: Apache-2.0
/// What `-D kind.parameter=value` and `-D kind=plugin` change of a scene.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/parameters.h"

namespace lampyris {

/// Parameters of a directive after changes; owns what was added.
class ChangedParameters {
 public:
  explicit ChangedParameters(const ParameterSet& original)
      : list_(original.parameters.begin(), original.parameters.end()),
        location_(original.location) {}

  /// Adds a value that counts instead of an earlier one.
  void add(const ParameterDeclaration& declaration, std::string_view value);
  void addFloats(std::string name, std::vector<float> values);
  void addString(std::string name, std::string value);
  /// Removes what none of the schemas declares.
  void keepDeclared(std::span<const Schema* const> schemas);
  ParameterSet set() const { return {list_, location_}; }

 private:
  OwnedParameter& own();
  std::vector<Parameter> list_;
  std::vector<std::unique_ptr<OwnedParameter>> owned_;
  SourceLocation location_;
};

class Overrides {
 public:
  /// Pairs of "kind.parameter" or "kind" and a value. Throws SceneError on an unknown kind.
  explicit Overrides(const std::vector<std::pair<std::string, std::string>>& settings);

  /// The plugin to use for a kind instead of the scene's; "": the scene's.
  std::string plugin(std::string_view kind) const;
  /// The value that is set for a parameter of a kind; "": none.
  std::string value(std::string_view kind, const ParameterDeclaration& declaration) const;
  /// Adds the settings of a kind to its parameters, each by the first of `schemas` that declares
  /// it. Throws SceneError if none does.
  void apply(std::string_view kind, std::span<const Schema* const> schemas,
             ChangedParameters& parameters) const;

 private:
  struct Setting {
    std::string kind, parameter, value;  ///< parameter "": the plugin itself
  };
  std::vector<Setting> settings_;
};

}  // namespace lampyris
