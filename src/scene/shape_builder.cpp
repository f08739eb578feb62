// SPDX-License-Identifier: Apache-2.0
#include "scene/shape_builder.h"

#include "lights/area_registry.h"
#include "scene/appearance_builder.h"
#include "scene/medium_builder.h"
#include "scene/plugin_lookup.h"
#include "shapes/registry.h"

namespace lampyris {

namespace {

/// What is looked up for a shape before shapes are created in parallel.
struct Plan {
  const ShapeRegistry::Entry* shape = nullptr;
  const AreaLightRegistry::Entry* light = nullptr;
  ParameterSet parameters, lightParameters;
};

class TransparentTexture final : public FloatTexture {
 public:
  float evaluate(const SurfaceInteraction&) const override { return 0; }
};

class ShapeBuilder {
 public:
  ShapeBuilder(BuildState& state, MediumBuilder& media)
      : state_(state),
        media_(media),
        appearance_(state),
        shapeFinder_(shapeRegistry()),
        lightFinder_(areaLightRegistry()),
        lightChecked_(state.description.areaLights.size()) {}

  BuiltShapes build();

 private:
  void listShapes(std::vector<BuiltShape>& out) const;
  Plan plan(BuiltShape& shape);
  void planLight(const BuiltShape& shape, Plan& plan);
  const FloatTexture* alpha(const Plan& plan, const ShapeDescription& d, std::string_view name);
  void create(BuiltShape& shape, const Plan& plan, std::unique_ptr<Shape>& out);

  BuildState& state_;
  MediumBuilder& media_;
  AppearanceBuilder appearance_;
  PluginFinder<ShapeRegistry> shapeFinder_;
  PluginFinder<AreaLightRegistry> lightFinder_;
  std::vector<bool> lightChecked_;
  const FloatTexture* transparent_ = nullptr;
};

void ShapeBuilder::listShapes(std::vector<BuiltShape>& out) const {
  const Description& d = state_.description;
  std::vector<bool> used(d.objects.size());
  for (const InstanceDescription& i : d.instances) used[i.object] = true;
  size_t nextObject = 0;
  for (uint32_t i = 0; i < d.shapes.size(); ++i) {
    while (nextObject < d.objects.size() && d.objects[nextObject].lastShape <= i) ++nextObject;
    const bool inObject = nextObject < d.objects.size() && d.objects[nextObject].firstShape <= i;
    if (inObject && !used[nextObject]) continue;
    BuiltShape& s = out.emplace_back();
    s.description = &d.shapes[i];
    if (inObject) s.object = static_cast<uint32_t>(nextObject);
    if (state_.isAnimated(s.description->transform)) s.motion = s.description->transform;
  }
}

void ShapeBuilder::planLight(const BuiltShape& shape, Plan& plan) {
  const ShapeDescription& d = *shape.description;
  if (d.areaLight == kNone) return;
  if (shape.motion != kNone) {
    state_.diagnostics.warn(d.plugin.parameters.location,
                            "a shape that moves does not emit: its area light is ignored");
    return;
  }
  const PluginUse& use = state_.description.areaLights[d.areaLight];
  const SourceLocation where = use.parameters.location;
  plan.light = &lightFinder_.find(use.name, where);
  plan.lightParameters = state_.spectra.resolve(use.parameters);
  if (!lightChecked_[d.areaLight]) {
    lightChecked_[d.areaLight] = true;
    const Schema* const schemas[] = {&plan.light->schema};
    checkParameters(plan.lightParameters, schemas, areaLightRegistry(), plan.light->name,
                    state_.diagnostics);
  }
  if (shape.object != kNone)
    state_.diagnostics.warn(d.plugin.parameters.location,
                            "an area light in an object is seen but lights nothing: light "
                            "sampling does not know instances");
}

Plan ShapeBuilder::plan(BuiltShape& shape) {
  const ShapeDescription& d = *shape.description;
  const SourceLocation where = d.plugin.parameters.location;
  Plan plan;
  plan.shape = &shapeFinder_.find(d.plugin.name, where);
  plan.parameters = state_.spectra.resolve(d.plugin.parameters);
  shape.primitive.material = appearance_.materialOf(d);
  shape.primitive.media = media_.interfaceOf(d.mediumInterface);
  const Schema* const material = appearance_.materialSchema(d);
  const Schema* const schemas[] = {&plan.shape->schema, material};
  checkParameters(plan.parameters, std::span(schemas, material ? 2 : 1), shapeRegistry(),
                  plan.shape->name, state_.diagnostics);
  shape.primitive.alpha = alpha(plan, d, "alpha");
  shape.primitive.shadowAlpha = alpha(plan, d, "shadowalpha");
  planLight(shape, plan);
  return plan;
}

/// As in pbrt-v3 a texture, or a number of which only 0 counts.
const FloatTexture* ShapeBuilder::alpha(const Plan& plan, const ShapeDescription& d,
                                        std::string_view name) {
  const Parameter* p = plan.parameters.find(name);
  if (!p || !plan.shape->schema.find(name)) return nullptr;
  FloatInput input(1);
  input.location = p->location;
  if (p->type == ParameterType::Texture && p->strings.size() == 1) input.texture = p->strings[0];
  if (p->type == ParameterType::Float && p->floats.size() == 1) input.value = p->floats[0];
  const TexturedFloat a = AppearanceBuilder::Resolver(appearance_, d.order).resolve(input);
  if (a.texture || a.value != 0) return a.texture;
  if (!transparent_)
    transparent_ =
        state_.job.scene.floatTextures.emplace_back(std::make_unique<TransparentTexture>()).get();
  return transparent_;
}

void ShapeBuilder::create(BuiltShape& shape, const Plan& plan, std::unique_ptr<Shape>& out) {
  const ShapeDescription& d = *shape.description;
  const SourceLocation where = d.plugin.parameters.location;
  const AppearanceBuilder::Resolver resolver(appearance_, d.order);
  const Transform toWorld =
      shape.motion == kNone ? state_.transform(d.transform, where) : Transform();
  out = plan.shape->create(plan.parameters,
                           {state_.context(where), resolver, toWorld, d.reverseOrientation});
  shape.primitive.shape = out.get();
  for (uint32_t e = 0; e < out->elementCount(); ++e) shape.bounds.extend(out->bounds(e));
  if (shape.motion != kNone) shape.bounds = state_.motion(shape.motion).bounds(shape.bounds);
  if (!plan.light) return;
  shape.light = plan.light->create(
      plan.lightParameters,
      {state_.context(plan.lightParameters.location), *out, state_.images, resolver});
  shape.primitive.light = shape.light.get();
}

BuiltShapes ShapeBuilder::build() {
  BuiltShapes built;
  listShapes(built.shapes);
  const size_t count = built.shapes.size();
  std::vector<Plan> plans(count);
  for (size_t i = 0; i < count; ++i) plans[i] = plan(built.shapes[i]);

  std::vector<std::unique_ptr<Shape>>& shapes = state_.job.scene.shapes;
  shapes.resize(count);
  parallelForEach(count, 1, [&](size_t i) { create(built.shapes[i], plans[i], shapes[i]); });

  built.objectBounds.resize(state_.description.objects.size());
  for (const BuiltShape& s : built.shapes)
    (s.object == kNone ? built.worldBounds : built.objectBounds[s.object]).extend(s.bounds);
  return built;
}

}  // namespace

BuiltShapes buildShapes(BuildState& state, MediumBuilder& media) {
  return ShapeBuilder(state, media).build();
}

}  // namespace lampyris
