// SPDX-License-Identifier: Apache-2.0
#include "scene/overrides.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/error.h"

namespace lampyris {

OwnedParameter& ChangedParameters::own() {
  return *owned_.emplace_back(std::make_unique<OwnedParameter>());
}

void ChangedParameters::add(const ParameterDeclaration& declaration, std::string_view value) {
  owned_.push_back(parseOverride(declaration, value));
  list_.push_back(owned_.back()->parameter);
}

void ChangedParameters::addFloats(std::string name, std::vector<float> values) {
  OwnedParameter& o = own();
  o.name = std::move(name);
  o.floats = std::move(values);
  o.parameter.name = o.name;
  o.parameter.type = ParameterType::Float;
  o.parameter.floats = o.floats;
  list_.push_back(o.parameter);
}

void ChangedParameters::addString(std::string name, std::string value) {
  OwnedParameter& o = own();
  o.name = std::move(name);
  o.strings.push_back(std::move(value));
  o.views.assign(o.strings.begin(), o.strings.end());
  o.parameter.name = o.name;
  o.parameter.type = ParameterType::String;
  o.parameter.strings = o.views;
  list_.push_back(o.parameter);
}

void ChangedParameters::keepDeclared(std::span<const Schema* const> schemas) {
  std::erase_if(list_, [&](const Parameter& p) {
    return std::none_of(schemas.begin(), schemas.end(),
                        [&p](const Schema* s) { return s->find(p.name) != nullptr; });
  });
}

Overrides::Overrides(const std::vector<std::pair<std::string, std::string>>& settings) {
  static const std::vector<std::string> kinds = {"integrator", "sampler", "film",
                                                 "camera",     "filter",  "lightsampler"};
  for (const auto& [key, value] : settings) {
    const size_t dot = key.find('.');
    Setting s{key.substr(0, dot), dot == std::string::npos ? "" : key.substr(dot + 1), value};
    if (std::find(kinds.begin(), kinds.end(), s.kind) == kinds.end())
      throw SceneError(fmt::format("-D {}: unknown kind \"{}\"{}; it is one of {}", key, s.kind,
                                   didYouMean(s.kind, kinds), fmt::join(kinds, ", ")));
    if (dot != std::string::npos && s.parameter.empty())
      throw SceneError(fmt::format("-D {}: expected kind.parameter=value or kind=plugin", key));
    // The integrator's parameter is what chooses the light sampler.
    if (s.kind == "lightsampler" && s.parameter.empty())
      s.kind = "integrator", s.parameter = "lightsampler";
    settings_.push_back(std::move(s));
  }
}

std::string Overrides::plugin(std::string_view kind) const {
  std::string name;
  for (const Setting& s : settings_)
    if (s.kind == kind && s.parameter.empty()) name = s.value;
  return name;
}

std::string Overrides::value(std::string_view kind, const ParameterDeclaration& declaration) const {
  std::string value;
  for (const Setting& s : settings_)
    if (s.kind == kind && declaration.matches(s.parameter)) value = s.value;
  return value;
}

void Overrides::apply(std::string_view kind, std::span<const Schema* const> schemas,
                      ChangedParameters& parameters) const {
  for (const Setting& s : settings_) {
    if (s.kind != kind || s.parameter.empty()) continue;
    std::vector<std::string> names;
    const ParameterDeclaration* declaration = nullptr;
    for (const Schema* schema : schemas) {
      if (!declaration) declaration = schema->find(s.parameter);
      const auto more = schema->names();
      names.insert(names.end(), more.begin(), more.end());
    }
    if (!declaration)
      throw SceneError(fmt::format("-D {}.{}: unknown parameter{}; there are: {}", kind,
                                   s.parameter, didYouMean(s.parameter, names),
                                   fmt::join(names, ", ")));
    parameters.add(*declaration, s.value);
  }
}

}  // namespace lampyris
