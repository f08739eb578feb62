// SPDX-License-Identifier: Apache-2.0
#include "light_scenes.h"

#include <gtest/gtest.h>

#include <map>

#include "core/sampling.h"
#include "lightdistributions/registry.h"
#include "lights/area_registry.h"
#include "lights/registry.h"
#include "materials/fresnel_blend.h"
#include "materials/lambert.h"
#include "materials/microfacet_reflection.h"
#include "materials/rough_dielectric.h"
#include "shapes/triangle_mesh.h"
#include "support/statistics.h"

namespace lampyris::test {
namespace {

Vec3 randomPoint(uint64_t i, uint32_t d) {
  return {uniform(21, i, d), uniform(21, i, d + 1), uniform(21, i, d + 2)};
}
Vec3 randomDirection(uint64_t i, uint32_t d) {
  return sampleUniformSphere({uniform(21, i, d), uniform(21, i, d + 1)});
}

/// Where the unit cube of a scene lies.
struct Place {
  float scale = 1;
  Vec3 offset{0};
  Vec3 operator()(const Vec3& p) const { return offset + scale * p; }
  operator Transform() const {
    return Transform::translate(offset) * Transform::scale(Vec3(scale));
  }
};

std::unique_ptr<LightScene> emptyScene(const std::string& name, const Place& place = {}) {
  auto s = std::make_unique<LightScene>();
  s->name = name;
  s->scale = place.scale;
  s->bounds = Bounds3(place(Vec3(0)), place(Vec3(1)));
  return s;
}

enum class Cloud { Points, Line, Spots };
void addCloud(LightScene& s, Cloud kind, size_t count, const Place& place = {}) {
  std::vector<CloudLight::Point> points(count);
  for (size_t i = 0; i < count; ++i) {
    points[i].p =
        place(kind == Cloud::Line ? Vec3(0.5f, uniform(21, i, 0), 0.5f) : randomPoint(i, 0));
    points[i].intensity = (uniform(21, i, 3) + 0.01f) * sqr(place.scale);
    if (kind != Cloud::Spots) continue;
    points[i].axis = randomDirection(i, 4);
    points[i].cosCone = std::cos(0.1f + uniform(21, i, 6));
  }
  s.add(std::make_unique<CloudLight>(std::move(points)));
}

void addNamed(LightScene& s, const std::string& name, const TestParameters::List& list,
              const Transform& lightToWorld = {}) {
  TestBuild build;
  ImageCache images;
  const auto& plugin = lightRegistry().get(name, {});
  const TestParameters p(plugin.schema, list);
  s.add(plugin.create(p.set(), LightContext{build.base(), lightToWorld, images}));
}

/// The last shape emits.
void addEmitter(LightScene& s, const TestParameters::List& list) {
  TestBuild build;
  ImageCache images;
  const auto& plugin = areaLightRegistry().get("diffuse", {});
  const TestParameters p(plugin.schema, list);
  s.add(plugin.create(p.set(),
                      AreaLightContext{build.base(), *s.shapes.back(), images, build.textures}));
}

void addQuads(LightScene& s, size_t count, bool twoSided, const Place& place = {}) {
  std::vector<Quad> quads(count);
  for (size_t i = 0; i < count; ++i) {
    const Vec3 a = randomDirection(i, 33), b = normalize(cross(a, randomDirection(i, 35)));
    quads[i] = {place(randomPoint(i, 30)), 0.1f * place.scale * a, 0.05f * place.scale * b};
  }
  s.shapes.push_back(std::make_unique<QuadShape>(std::move(quads)));
  addEmitter(s, {{"twosided", twoSided ? "true" : "false"}, {"L", "90 90 90"}});
}

/// Slide projectors and goniometric lights that face all ways, half of them with an image.
void addPatterns(LightScene& s, size_t count, const Transform& cube) {
  Image image(5, 3, 3);
  for (size_t i = 0; i < image.data().size(); ++i) image.data()[i] = i % 4 ? 0.f : 1.f;
  const std::string map = testing::TempDir() + "pattern.pfm";
  writeImageFile(map, image);
  for (size_t i = 0; i < count; ++i) {
    const Transform place = cube * Transform::translate(randomPoint(i, 70)) *
                            Transform::rotate(360 * uniform(21, i, 73), randomDirection(i, 74));
    TestParameters::List list;
    if (i % 2) list.push_back({"mapname", map});
    addNamed(s, "goniometric", list, place);
    list.push_back({"fov", std::to_string(1 + 150 * uniform(21, i, 76))});
    addNamed(s, "projection", list, place);
  }
}

/// A square of 200 triangles that emits a picture: a third black, one texel very bright.
void addPicture(LightScene& s, const Place& place) {
  Image image(7, 6, 3);
  for (size_t i = 0; i < image.data().size(); ++i)
    image.data()[i] = i < 42 ? 0.f : uniform(21, i, 80);
  image.setRgb(5, 4, Rgb(500));
  const std::string path = testing::TempDir() + "picture.pfm";
  writeImageFile(path, image);

  constexpr uint32_t kSide = 10;
  TriangleMeshData mesh;
  for (uint32_t i = 0; i < (kSide + 1) * (kSide + 1); ++i) {
    const Vec2 at = Vec2(i % (kSide + 1), i / (kSide + 1)) / static_cast<float>(kSide);
    mesh.positions.push_back(place({at.x, at.y, 0.5f}));
    mesh.uvs.push_back(at);
  }
  for (uint32_t y = 0; y < kSide; ++y)
    for (uint32_t x = 0; x < kSide; ++x) {
      const uint32_t i = y * (kSide + 1) + x, above = i + kSide + 1;
      mesh.indices.insert(mesh.indices.end(), {i, i + 1, above + 1, i, above + 1, above});
    }
  s.shapes.push_back(std::make_unique<TriangleMesh>(std::move(mesh), Transform(), false));
  addEmitter(s, {{"filename", path}, {"twosided", "true"}});
}

std::unique_ptr<LightScene> mixed(const std::string& name, const Place& place) {
  auto s = emptyScene(name, place);
  addNamed(*s, "distant", {{"to", "0 0 0"}, {"from", "1 2 3"}, {"L", "20 20 20"}});
  addCloud(*s, Cloud::Points, 30, place);
  addQuads(*s, 40, false, place);
  addNamed(*s, "infinite", {{"L", "4 4 4"}});
  addCloud(*s, Cloud::Spots, 40, place);
  addQuads(*s, 20, true, place);
  addNamed(*s, "distant", {{"to", "0 0 0"}, {"from", "-1 0 0.5"}, {"L", "7 7 7"}});
  return s;
}

}  // namespace

std::optional<LightSample> CloudLight::sample(uint32_t i, const Vec3& from, const Vec2&) const {
  const Vec3 d = points_[i].p - from;
  const float squared = lengthSquared(d);
  LightSample s;
  s.wi = normalize(d);
  s.distance = std::sqrt(squared);
  s.radiance = Rgb(points_[i].intensity / squared);
  s.pdf = 1;
  s.p = points_[i].p;
  if (!(squared > 0) || s.radiance.isBlack() || !s.radiance.isFinite()) return std::nullopt;
  if (dot(-s.wi, points_[i].axis) < points_[i].cosCone) return std::nullopt;
  return s;
}

std::optional<LightBounds> CloudLight::bounds(uint32_t i) const {
  LightBounds b;
  b.box = Bounds3(points_[i].p);
  b.intensity = points_[i].intensity;
  if (points_[i].cosCone > -1) {
    b.axis = points_[i].axis;
    b.cosThetaO = 1;
    b.cosThetaE = points_[i].cosCone;
  }
  return b;
}

std::vector<std::unique_ptr<LightScene>> smallLightScenes(float scale) {
  std::vector<std::unique_ptr<LightScene>> all;
  const Place place{scale, Vec3(0)};
  const std::string suffix = scale == 1 ? "" : scale < 1 ? ", tiny" : ", huge";
  const auto keep = [&](const std::string& name) -> LightScene& {
    all.push_back(emptyScene(name + suffix, place));
    return *all.back();
  };
  const auto named = [&](LightScene& s, const std::string& name, const TestParameters::List& list) {
    addNamed(s, name, list, place);
  };
  keep("none");
  named(keep("one point"), "point", {{"from", "0.5 0.5 0.5"}});
  named(keep("one sky"), "infinite", {});
  named(keep("one spot"), "spot", {{"to", "1 1 1"}});
  addCloud(keep("points"), Cloud::Points, 1000, place);
  addCloud(keep("line"), Cloud::Line, 300, place);
  addCloud(keep("spots"), Cloud::Spots, 300, place);
  addQuads(keep("one-sided"), 150, false, place);
  addQuads(keep("two-sided"), 150, true, place);
  addPatterns(keep("patterns"), 60, place);
  addPicture(keep("picture"), place);
  LightScene& suns = keep("no positions");
  named(suns, "distant", {{"to", "0 0 0"}, {"from", "0 0 1"}});
  named(suns, "distant", {{"to", "0 0 0"}, {"from", "0 0 -1"}});
  named(suns, "distant", {{"to", "0 0 0"}, {"from", "0 1 1"}, {"L", "0 0 0"}});
  all.push_back(mixed("mixed" + suffix, place));
  all.push_back(mixed("mixed, far away" + suffix, {scale, scale * Vec3(1e4f, -2e4f, 5e3f)}));
  LightScene& dark = keep("some without power");
  named(dark, "point", {{"I", "0 0 0"}});
  named(dark, "point", {{"from", "0.2 0.3 0.9"}});
  named(dark, "infinite", {{"L", "0 0 0"}});
  named(dark, "spot", {{"from", "0.9 0.3 0.9"}, {"to", "0.2 0.2 0.2"}, {"coneangle", "60"}});
  named(keep("all without power"), "point", {{"I", "0 0 0"}});
  LightScene& contrast = keep("intensities");
  for (const char* i : {"1e-12", "1e12", "1"})
    named(contrast, "point",
          {{"I", std::string(i) + " " + i + " " + i}, {"from", i[1] == 'e' ? "1 0 0" : "0 0 1"}});
  return all;
}

std::unique_ptr<LightScene> coincidentLights(size_t count) {
  auto s = emptyScene("coincident");
  s->add(std::make_unique<CloudLight>(std::vector<CloudLight::Point>(count, {Vec3(0.5f)})));
  return s;
}

std::unique_ptr<LightScene> manyLights(size_t count) {
  auto s = emptyScene("many");
  addCloud(*s, Cloud::Points, count);
  return s;
}

namespace {

/// Lobes of all kinds in the frame of the context with the number k, made once.

const Bsdf* glossySurface(int k, const LightSampleContext& c) {
  static std::map<int, Bsdf> all;
  const auto [found, isNew] = all.try_emplace(k);
  Bsdf& bsdf = found->second;
  if (!isNew) return &bsdf;
  SurfaceInteraction at;
  at.n = c.n;
  at.shading.n = c.ns;
  bsdf.reset(at);
  const TrowbridgeReitz facets(0.02f * static_cast<float>(1 + k), 0.1f);
  if (k % 3 == 0) bsdf.add<RoughDielectric<>>(Rgb(1), Rgb(0.5f), facets, 1.5f);
  if (k % 3 == 1) bsdf.add<FresnelBlend>(Rgb(0.5f), Rgb(0.1f), facets);
  if (k % 3 == 2) {
    bsdf.add<LambertTransmission>(Rgb(0.3f));
    const ConductorFresnel metal{Rgb(0.2f), Rgb(3)};
    bsdf.add<MicrofacetReflection<ConductorFresnel>>(Rgb(1), facets, metal);
  }
  return &bsdf;
}

}  // namespace

std::vector<LightSampleContext> contextsFor(const LightScene& scene, int count) {
  static const Bsdf surface{};  // most distributions ask only whether there is one
  std::vector<LightSampleContext> all;
  for (int k = 0; k < count; ++k) {
    const auto i = static_cast<uint64_t>(k);
    LightSampleContext c;
    const Vec3 extent = scene.bounds.extent();
    c.p = scene.bounds.min + (randomPoint(i, 50) * 1.5f - 0.25f) * extent;
    if (k % 6 == 5 && scene.table.size()) {
      const auto entry = scene.table[static_cast<LightId>(i * 7 % scene.table.size())];
      if (const auto b = entry.light->bounds(entry.element)) c.p = b->box.min;
    }
    if (k % 13 == 12) c.p = scene.bounds.max + 50.f * extent;
    c.n = k % 7 == 6 ? Vec3(0, 0, 1) : randomDirection(i, 60);
    c.ns = k % 2 ? c.n : normalize(c.n + 0.6f * randomDirection(i, 62));
    c.wo = randomDirection(i, 64);
    c.reflects = k % 4 != 1;
    c.transmits = k % 4 == 1 || k % 4 == 3;
    c.bsdf = k % 8 == 7 ? nullptr : k % 5 < 2 ? &surface : glossySurface(k, c);
    all.push_back(c);
  }
  LightSampleContext nothing;
  nothing.reflects = nothing.transmits = false;
  nothing.bsdf = &surface;
  all.push_back(nothing);
  return all;
}

double contribution(const LightScene& scene, const LightSampleContext& ctx, LightId light,
                    const Vec2& u) {
  const auto entry = scene.table[light];
  const auto s = entry.light->sample(entry.element, ctx.p, u);
  if (!s || !(ctx.reflects || ctx.transmits)) return 0;
  float cosine = 1;
  if (ctx.bsdf || !(ctx.reflects && ctx.transmits)) {
    const bool sameSide = dot(s->wi, ctx.n) * dot(ctx.wo, ctx.n) > 0;
    if (!(sameSide ? ctx.reflects : ctx.transmits)) return 0;
    cosine = absDot(s->wi, ctx.ns);
  }
  return static_cast<double>(s->radiance.luminance() * cosine) / static_cast<double>(s->pdf);
}

std::unique_ptr<LightDistribution> DistributionMaker::make(const std::string& name,
                                                           const LightScene& scene,
                                                           const TestParameters::List& list) {
  const auto& plugin = lightDistributionRegistry().get(name, {});
  const TestParameters p(plugin.schema, list);
  return plugin.create(
      p.set(), LightDistributionContext{build.base(), scene.table, scene.bounds, statistics});
}

}  // namespace lampyris::test
