// SPDX-License-Identifier: Apache-2.0
// Film, camera and sampler: what looks at the scene.
#include "cameras/moving_camera.h"
#include "cameras/registry.h"
#include "film/film_registry.h"
#include "film/filter_registry.h"
#include "samplers/registry.h"
#include "scene/build_state.h"
#include "scene/plugin_lookup.h"

namespace lampyris {

namespace {

/// A directive's plugin, and its parameters with the overrides of its kind.
template <class R>
struct Choice {
  Choice(BuildState& state, const R& registry, const PluginUse& use, std::string_view kind,
         std::string_view defaultName)
      : parameters(state.spectra.resolve(use.parameters)) {
    const std::string other = state.overrides.plugin(kind);
    const bool given = use.parameters.location.known();
    plugin = other.empty()
                 ? &findPlugin(registry, given ? use.name : defaultName, use.parameters.location)
                 : &findPlugin(registry, other, {});
    const Schema* const schemas[] = {&plugin->schema};
    // Parameters that were meant for another plugin say nothing to this one.
    if (!other.empty() && other != use.name) parameters.keepDeclared(schemas);
    checkParameters(parameters.set(), schemas, registry, plugin->name, state.diagnostics);
    state.overrides.apply(kind, schemas, parameters);
  }
  const typename R::Entry* plugin;
  ChangedParameters parameters;
};

/// What cameras want to know of the film's parameters.
struct FilmSize {
  float diagonal = 35;  ///< in millimetres
  void declare(Declaration& d) { d.add("diagonal", diagonal, "Diagonal of the film."); }
};

ParameterSet buildFilm(BuildState& state, Choice<FilmRegistry>& film) {
  const Description& d = state.description;
  const Choice filter(state, filterRegistry(), d.filter, "filter", "box");
  auto filterObject = filter.plugin->create(filter.parameters.set(), {});
  if (!state.options.outputPath.empty())
    film.parameters.addString("filename", state.options.outputPath);
  if (!state.options.cropWindow.empty())
    film.parameters.addFloats("cropwindow", state.options.cropWindow);
  const ParameterSet set = film.parameters.set();
  state.job.film = film.plugin->create(set, {state.context(set.location), filterObject});
  return set;
}

}  // namespace

void buildView(BuildState& state) {
  const Description& d = state.description;
  RenderJob& job = state.job;

  Choice film(state, filmRegistry(), d.film, "film", "image");
  const ParameterSet filmParameters = buildFilm(state, film);

  FilmSize filmSize;
  Schema::of<FilmSize>().read(filmParameters, &filmSize);

  const Choice camera(state, cameraRegistry(), d.camera, "camera", "perspective");
  const ParameterSet cameraParameters = camera.parameters.set();
  const uint32_t transform = d.cameraTransform;
  const bool moves = state.isAnimated(transform);
  const Transform cameraToWorld = moves ? Transform() : d.transforms[transform].start.inverse();
  job.camera = camera.plugin->create(cameraParameters,
                                     {state.context(cameraParameters.location), cameraToWorld,
                                      job.film->resolution(), filmSize.diagonal});
  if (moves) {
    const TransformPair& pair = d.transforms[transform];
    job.camera = std::make_unique<MovingCamera>(
        std::move(job.camera), AnimatedTransform(pair.start.inverse(), d.transformTimes[0],
                                                 pair.end.inverse(), d.transformTimes[1]));
  }

  const Choice sampler(state, samplerRegistry(), d.sampler, "sampler", "bluenoise");
  job.sampler = sampler.plugin->create(
      sampler.parameters.set(),
      {state.options.samplesPerPixel, state.options.seed, job.film->bounds()});
}

}  // namespace lampyris
