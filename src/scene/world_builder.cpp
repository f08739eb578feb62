// SPDX-License-Identifier: Apache-2.0
// Shapes and lights, in the order that lets each know what it needs: shapes, area lights, the
// scene's bounds, the lights' power, their numbers, and the ray tracer's scene at last.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>

#include "accelerators/embree_geometry.h"
#include "accelerators/embree_memory.h"
#include "core/memory.h"
#include "scene/build_state.h"
#include "scene/light_builder.h"
#include "scene/medium_builder.h"
#include "scene/shape_builder.h"

namespace lampyris {

namespace {

/// Of primitives and instances; a point where there are none, so that it has a centre.
Bounds3 sceneBounds(const BuiltShapes& built, const BuildState& state) {
  const Description& d = state.description;
  Bounds3 bounds = built.worldBounds;
  for (const InstanceDescription& i : d.instances) {
    const Bounds3& object = built.objectBounds[i.object];
    if (object.empty()) continue;
    bounds.extend(state.isAnimated(i.transform) ? state.motion(i.transform).bounds(object)
                                                : d.transforms[i.transform].start.bounds(object));
  }
  return bounds.empty() ? Bounds3(Vec3(0)) : bounds;
}

/// Shapes of one object (or of the world) that move alike, as a definition of their own.
struct MovingGroup {
  uint32_t motion, definition;
};

class GeometryDescriber {
 public:
  explicit GeometryDescriber(const BuildState& state)
      : state_(state), definitions_(state.description.objects.size(), kNone) {}

  GeometryDescription describe(const BuiltShapes& built) {
    for (const BuiltShape& s : built.shapes) primitives(s).push_back(s.primitive);
    addMoving(kNone, kNone);
    for (const InstanceDescription& i : state_.description.instances) {
      if (definitions_[i.object] != kNone) addInstance(definitions_[i.object], i.transform, kNone);
      addMoving(i.object, i.transform);
    }
    return std::move(out_);
  }

 private:
  uint32_t newDefinition() {
    out_.objects.emplace_back();
    return static_cast<uint32_t>(out_.objects.size() - 1);
  }

  /// Where a shape belongs.
  std::vector<Primitive>& primitives(const BuiltShape& s) {
    if (s.motion == kNone) {
      if (s.object == kNone) return out_.primitives;
      uint32_t& definition = definitions_[s.object];
      if (definition == kNone) definition = newDefinition();
      return out_.objects[definition].primitives;
    }
    // Shapes that move alike follow each other in the file.
    const auto end = moving_.upper_bound(s.object);
    const auto last = end == moving_.begin() ? moving_.end() : std::prev(end);
    const bool known =
        last != moving_.end() && last->first == s.object && last->second.motion == s.motion;
    const auto group = known ? last : moving_.insert({s.object, {s.motion, newDefinition()}});
    return out_.objects[group->second.definition].primitives;
  }

  void addMoving(uint32_t object, uint32_t outer) {
    const auto [first, last] = moving_.equal_range(object);
    for (auto group = first; group != last; ++group)
      addInstance(group->second.definition, outer, group->second.motion);
  }

  /// By the transform `outer` of an instance and `inner` of a shape; kNone: none.
  void addInstance(uint32_t definition, uint32_t outer, uint32_t inner) {
    ObjectInstance& instance = out_.instances.emplace_back();
    instance.object = definition;
    if (outer != kNone) instance.instanceToWorld = state_.description.transforms[outer].start;
    if (inner == kNone && !state_.isAnimated(outer)) return;
    if (outer != kNone) instance.motion.push_back(state_.motion(outer));
    if (inner != kNone) instance.motion.push_back(state_.motion(inner));
  }

  const BuildState& state_;
  std::vector<uint32_t> definitions_;            ///< of objects' still shapes, in the output
  std::multimap<uint32_t, MovingGroup> moving_;  ///< by object, in the file's order
  GeometryDescription out_;
};

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
  set("media", scene.media.size());
  set("light objects", scene.lightTable.objectCount());
  set("lights", scene.lightTable.size());
}

/// Names the shape of the most triangles or other elements, though all count.
void expectGeometryMemory(const BuiltShapes& built, const GeometryDescription& g) {
  size_t triangles = 0, others = 0, most = 0;
  SourceLocation where;
  for (const BuiltShape& s : built.shapes) {
    const Shape& shape = *s.primitive.shape;
    const size_t count = shape.elementCount();
    (shape.triangles().triangleCount > 0 ? triangles : others) += count;
    if (count <= most) continue;
    most = count;
    where = s.description->plugin.parameters.location;
  }
  expectMemory(estimateEmbreeMemory(g),
               fmt::format("the ray tracing structure of {} triangles, {} elements of other shapes "
                           "(of this shape: {}) and {} instances",
                           triangles, others, most, g.instances.size()),
               where);
}

}  // namespace

void buildWorld(BuildState& state) {
  Scene& scene = state.job.scene;
  MediumBuilder media(state);
  BuiltShapes built = buildShapes(state, media);
  scene.cameraMedium = media.interfaceOf(state.description.cameraMediumInterface).outside;
  for (const BuiltShape& s : built.shapes)
    scene.hasInterfaces = scene.hasInterfaces || !s.primitive.material;
  buildLights(state, built, sceneBounds(built, state));
  GeometryDescription geometry = GeometryDescriber(state).describe(built);
  reportSizes(state, built, geometry);
  expectGeometryMemory(built, geometry);
  scene.geometry = makeEmbreeGeometry(std::move(geometry));
  scene.bounds = scene.geometry->bounds();
  if (scene.bounds.empty()) scene.bounds = Bounds3(Vec3(0));
}

}  // namespace lampyris
