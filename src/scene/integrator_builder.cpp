// SPDX-License-Identifier: Apache-2.0
// The integrator, and the light distribution that its parameters describe.
#include "core/memory.h"
#include "integrators/registry.h"
#include "lightdistributions/registry.h"
#include "scene/build_state.h"
#include "scene/plugin_lookup.h"

namespace lampyris {

namespace {

constexpr const char *kManyLights = "bvh", *kOneLight = "uniform";

const IntegratorRegistry::Entry& choosePlugin(BuildState& state) {
  const PluginUse& use = state.description.integrator;
  const SourceLocation where = use.parameters.location;
  const IntegratorRegistry& registry = integratorRegistry();
  const std::string other = state.overrides.plugin("integrator");
  if (!other.empty()) return findPlugin(registry, other, {});
  if (!where.known()) return findPlugin(registry, "path", where);
  return findPlugin(registry, use.name, where);
}

/// Integrator "pathtree" takes a number for the light tree in place of a light sampler's name.
bool isName(std::string_view lightSampler) {
  return !lightSampler.empty() &&
         lightSampler.find_first_not_of("+-.0123456789eE") != std::string_view::npos;
}

/// The light sampler whose parameters may stand among the integrator's: the named one, else that of
/// scenes with many lights.
const LightDistributionRegistry::Entry* lightSamplerOf(const BuildState& state,
                                                       const Schema& integrator,
                                                       const ParameterSet& set) {
  const LightDistributionRegistry& registry = lightDistributionRegistry();
  if (const ParameterDeclaration* d = integrator.find("lightsampler")) {
    const std::string chosen = state.overrides.value("integrator", *d);
    if (isName(chosen)) return &findPlugin(registry, chosen, {});
    const Parameter* p = findDeclared(set, *d);
    if (chosen.empty() && p && p->strings.size() == 1 && isName(p->strings[0]))
      return &findPlugin(registry, p->strings[0], p->location);
  }
  return registry.find(kManyLights);
}

}  // namespace

IntegratorChoice chooseIntegrator(BuildState& state) {
  const PluginUse& use = state.description.integrator;
  const auto& plugin = choosePlugin(state);
  IntegratorChoice choice{&plugin, ChangedParameters(state.spectra.resolve(use.parameters))};

  std::vector<const Schema*> schemas{&plugin.schema}, samplerSchemas;
  if (const auto* sampler = lightSamplerOf(state, plugin.schema, use.parameters)) {
    schemas.push_back(&sampler->schema);
    samplerSchemas.push_back(&sampler->schema);
  }
  const bool replaced = !state.overrides.plugin("integrator").empty();
  // Parameters that were meant for another plugin say nothing to this one.
  if (replaced && plugin.name != use.name) choice.parameters.keepDeclared(schemas);
  checkParameters(choice.parameters.set(), schemas, integratorRegistry(), plugin.name,
                  state.diagnostics);
  state.overrides.apply("integrator", schemas, choice.parameters);
  state.overrides.apply("lightsampler", samplerSchemas, choice.parameters);
  return choice;
}

void buildIntegrator(BuildState& state, const IntegratorChoice& choice) {
  const ParameterSet set = choice.parameters.set();
  const Scene& scene = state.job.scene;
  const auto lightDistribution = [&](const std::string& name,
                                     const IntegratorContext::Settings& settings) {
    const char* const usual = scene.lightTable.size() > 1 ? kManyLights : kOneLight;
    const std::string used = name.empty() ? usual : name;
    const auto& plugin = findPlugin(lightDistributionRegistry(), used, set.location);
    ChangedParameters parameters(set);
    for (const auto& [parameter, value] : settings)
      parameters.add(*plugin.schema.find(parameter), value);
    return plugin.create(parameters.set(), {state.context(set.location), scene.lightTable,
                                            scene.bounds, state.statistics});
  };
  state.job.integrator = choice.plugin->create(
      set, {state.context(set.location), scene, lightDistribution, state.options.seed});
  expectMemory(state.job.integrator->memory(*state.job.film),
               "integrator \"" + choice.plugin->name + "\"", set.location);
  if (!scene.media.empty() && !state.job.integrator->rendersMedia())
    state.diagnostics.warn(set.location, "integrator \"" + choice.plugin->name +
                                             "\" does not render participating media: they are "
                                             "ignored (\"volpath\" renders them)");
}

}  // namespace lampyris
