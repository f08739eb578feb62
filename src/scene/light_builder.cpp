// SPDX-License-Identifier: Apache-2.0
#include "scene/light_builder.h"

#include "core/parallel.h"
#include "lights/registry.h"
#include "scene/plugin_lookup.h"

namespace lampyris {

namespace {

constexpr size_t kGrain = 512;

bool isBlack(const Light& light) {
  for (uint32_t e = 0; e < light.elementCount(); ++e)
    if (!light.power(e).isBlack()) return false;
  return true;
}

std::vector<const LightRegistry::Entry*> findPlugins(const Description& d) {
  std::vector<const LightRegistry::Entry*> plugins(d.lights.size());
  PluginFinder finder(lightRegistry());
  for (size_t i = 0; i < d.lights.size(); ++i)
    plugins[i] = &finder.find(d.lights[i].plugin.name, d.lights[i].plugin.parameters.location);
  return plugins;
}

std::vector<std::unique_ptr<Light>> createLights(BuildState& state) {
  const Description& d = state.description;
  const auto plugins = findPlugins(d);
  // Files are opened by one thread.
  if (d.lightsNameSpectrumFiles)
    for (const LightDescription& l : d.lights) state.spectra.resolve(l.plugin.parameters);

  std::vector<std::unique_ptr<Light>> lights(d.lights.size());
  const size_t pieces = (lights.size() + kGrain - 1) / kGrain;
  parallelForEach(pieces, 1, [&](size_t piece) {
    // One context for many lights: to copy its function costs as much as to create a light.
    LightContext context{state.context({}), {}, state.images};
    uint32_t transform = 0;
    const size_t end = std::min(lights.size(), (piece + 1) * kGrain);
    for (size_t i = piece * kGrain; i < end; ++i) {
      const LightDescription& l = d.lights[i];
      context.location = l.plugin.parameters.location;
      if (l.transform != transform) {
        transform = l.transform;
        context.lightToWorld = state.transform(transform, context.location);
      }
      const ParameterSet set = d.lightsNameSpectrumFiles
                                   ? state.spectra.resolve(l.plugin.parameters)
                                   : l.plugin.parameters;
      const Schema* const schemas[] = {&plugins[i]->schema};
      checkParameters(set, schemas, lightRegistry(), plugins[i]->name, state.diagnostics);
      lights[i] = plugins[i]->create(set, context);
    }
  });
  return lights;
}

/// Which of the lights never emit anything, after all were told the scene's bounds.
std::vector<uint8_t> findBlack(const std::vector<Light*>& lights, const Bounds3& sceneBounds) {
  std::vector<uint8_t> black(lights.size());
  parallelFor(lights.size(), kGrain, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      lights[i]->prepare(sceneBounds);
      black[i] = isBlack(*lights[i]);
    }
  });
  return black;
}

/// Enters lights into the scene; those of shapes and those without are called in the file's order.
class LightEntry {
 public:
  LightEntry(Scene& scene, const Bounds3& bounds)
      : scene_(scene), hasExtent_(bounds.extent() != Vec3(0)) {}

  void addSource(std::unique_ptr<Light> light, bool isBlack) {
    const bool escapes = light->isInfinite() && !light->isDelta();
    // In a scene without extent, no light from infinity has power; a background is seen all the
    // same.
    if (isBlack && !(escapes && !hasExtent_)) {
      ++dropped_;
      return;
    }
    const LightId id = isBlack ? kNoLight : scene_.lightTable.add(light.get());
    if (escapes) {
      scene_.infiniteLights.push_back(light.get());
      scene_.infiniteLightIds.push_back(id);
    }
    scene_.lights.push_back(std::move(light));
  }

  void addEmitter(BuiltShape& shape, bool isBlack) {
    if (isBlack) {
      ++dropped_;
      shape.primitive.light = nullptr;
      shape.light.reset();
      return;
    }
    if (shape.object == kNone) {
      shape.primitive.firstLight = scene_.lightTable.add(shape.light.get());
      shape.primitive.isOneLight = shape.light->elementCount() == 1;
    }
    scene_.lights.push_back(std::move(shape.light));
  }

  size_t dropped() const { return dropped_; }

 private:
  Scene& scene_;
  bool hasExtent_;
  size_t dropped_ = 0;
};

}  // namespace

void buildLights(BuildState& state, BuiltShapes& shapes, const Bounds3& sceneBounds) {
  std::vector<std::unique_ptr<Light>> sources = createLights(state);
  std::vector<BuiltShape*> emitters;
  for (BuiltShape& s : shapes.shapes)
    if (s.light) emitters.push_back(&s);

  std::vector<Light*> all;
  all.reserve(sources.size() + emitters.size());
  for (const auto& light : sources) all.push_back(light.get());
  for (const BuiltShape* s : emitters) all.push_back(s->light.get());
  const std::vector<uint8_t> black = findBlack(all, sceneBounds);

  Scene& scene = state.job.scene;
  scene.lights.reserve(all.size());
  LightEntry entry(scene, sceneBounds);
  size_t next = 0;
  for (size_t i = 0; i < sources.size(); ++i) {
    const uint32_t order = state.description.lights[i].order;
    for (; next < emitters.size() && emitters[next]->description->order < order; ++next)
      entry.addEmitter(*emitters[next], black[sources.size() + next]);
    entry.addSource(std::move(sources[i]), black[i]);
  }
  for (; next < emitters.size(); ++next)
    entry.addEmitter(*emitters[next], black[sources.size() + next]);
  state.statistics.set("scene", "lights dropped (no power)", static_cast<double>(entry.dropped()));
}

}  // namespace lampyris
