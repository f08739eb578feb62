// SPDX-License-Identifier: Apache-2.0
// Shapes and lights, in the order that lets each know what it needs: shapes, area lights, the
// scene's bounds, the lights' power, their numbers, and the ray tracer's scene at last.
#include <algorithm>

#include "accelerators/embree_geometry.h"
#include "scene/build_state.h"
#include "scene/light_builder.h"
#include "scene/shape_builder.h"

namespace lampyris {

namespace {

void warnOfMedia(const BuildState& state) {
  const Description& d = state.description;
  if (d.media.empty() && d.mediumInterfaces.empty()) return;
  const SourceLocation where =
      d.media.empty() ? d.mediumInterfaces[0].location : d.media[0].plugin.parameters.location;
  state.diagnostics.warn(where, "participating media are not rendered yet: they are ignored");
}

/// Of primitives and instances; a point where there are none, so that it has a centre.
Bounds3 sceneBounds(const BuiltShapes& built, const Description& d) {
  Bounds3 bounds = built.worldBounds;
  for (const InstanceDescription& i : d.instances) {
    const Bounds3& object = built.objectBounds[i.object];
    if (!object.empty()) bounds.extend(d.transforms[i.transform].start.bounds(object));
  }
  return bounds.empty() ? Bounds3(Vec3(0)) : bounds;
}

GeometryDescription describeGeometry(const BuildState& state, const BuiltShapes& built) {
  const Description& d = state.description;
  GeometryDescription g;
  std::vector<uint32_t> objectIndex(d.objects.size(), kNone);
  for (const BuiltShape& s : built.shapes) {
    if (s.object == kNone) {
      g.primitives.push_back(s.primitive);
      continue;
    }
    uint32_t& index = objectIndex[s.object];
    if (index == kNone) {
      index = static_cast<uint32_t>(g.objects.size());
      g.objects.emplace_back();
    }
    g.objects[index].primitives.push_back(s.primitive);
  }
  for (const InstanceDescription& i : d.instances)
    if (objectIndex[i.object] != kNone)
      g.instances.push_back({objectIndex[i.object], state.transform(i.transform, i.location)});
  return g;
}

void reportSizes(const BuildState& state, const BuiltShapes& built, const GeometryDescription& g) {
  size_t triangles = 0;
  for (const BuiltShape& s : built.shapes)
    triangles += s.primitive.shape->triangles().triangleCount;
  Statistics& statistics = state.statistics;
  const Scene& scene = state.job.scene;
  const auto set = [&statistics](const char* name, size_t value) {
    statistics.set("scene", name, static_cast<double>(value));
  };
  set("shapes", built.shapes.size());
  set("shapes skipped (of unused objects)", state.description.shapes.size() - built.shapes.size());
  set("triangles", triangles);
  set("objects", g.objects.size());
  set("instances", g.instances.size());
  set("materials", scene.materials.size());
  set("textures", scene.floatTextures.size() + scene.spectrumTextures.size());
  set("light objects", scene.lightTable.objectCount());
  set("lights", scene.lightTable.size());
}

}  // namespace

void buildWorld(BuildState& state) {
  Scene& scene = state.job.scene;
  warnOfMedia(state);
  BuiltShapes built = buildShapes(state);
  buildLights(state, built, sceneBounds(built, state.description));
  GeometryDescription geometry = describeGeometry(state, built);
  reportSizes(state, built, geometry);
  scene.geometry = makeEmbreeGeometry(std::move(geometry));
  scene.bounds = scene.geometry->bounds();
  if (scene.bounds.empty()) scene.bounds = Bounds3(Vec3(0));
}

}  // namespace lampyris
