// SPDX-License-Identifier: Apache-2.0
#include "material_cases.h"

#include "core/frame.h"
#include "fourier_file.h"
#include "materials/registry.h"

namespace lampyris::test {

namespace {

/// Notes what a model lacks.
void describe(MaterialCase& c) {
  c.reciprocal = c.plugin != "hair" && c.plugin != "fourier" &&
                 std::none_of(c.parameters.begin(), c.parameters.end(),
                              [](const auto& p) { return p.second == "hair"; });
  // Burley's terms are added up without regard for each other: rough white surfaces are too bright
  // at grazing angles, and from below all light is mirrored beyond the critical angle as well.
  if (c.plugin == "disney") c.largestAlbedo = 1.7f;
}

MaterialCase defaults(const std::string& plugin) {
  MaterialCase c{plugin, neededParameters(plugin)};
  if (plugin == "metal" || plugin == "translucent") c.subdivisions = 30;
  describe(c);
  return c;
}

}  // namespace

TestParameters::List neededParameters(const std::string& plugin) {
  if (plugin == "mix") return {{"namedmaterial1", "diffuse"}, {"namedmaterial2", "mirror"}};
  if (plugin == "fourier") return {{"bsdffile", paperFile()}};
  return {};
}

std::string MaterialCase::label() const {
  std::string s = plugin;
  for (const auto& [name, value] : parameters) s += " " + name + "=" + value;
  return s;
}

std::vector<MaterialCase> materialCases() {
  std::vector<MaterialCase> all;
  for (const auto& e : materialRegistry().entries()) all.push_back(defaults(e.name));
  std::vector<MaterialCase> variants = {
      {"matte", {{"Kd", "0.9 0.5 0"}, {"sigma", "20"}}},
      {"matte", {{"Kd", "@checks"}, {"sigma", "90"}}},
      {"plastic", {{"Kd", "0.1 0.6 0.2"}, {"Ks", "0.4 0.4 0.4"}, {"roughness", "0.3"}}},
      {"plastic", {{"Kd", "0 0 0"}, {"roughness", "@half"}}},
      {"plastic", {{"Ks", "0 0 0"}}},
      {"plastic", {{"roughness", "0.2"}, {"remaproughness", "false"}}},
      {"metal", {{"uroughness", "0.1"}, {"vroughness", "0.6"}}, 1.5f, 20},
      {"metal", {{"eta", "1.5 0.1 1"}, {"k", "0 5 1"}, {"roughness", "1"}}},
      {"glass", {{"uroughness", "0.2"}, {"vroughness", "0.2"}}, 1.5f, 40},
      {"glass", {{"uroughness", "0.1"}, {"vroughness", "0.8"}, {"index", "2"}}, 2, 40},
      {"glass", {{"uroughness", "0.3"}, {"vroughness", "0.3"}, {"eta", "0.7"}}, 0.7f, 20},
      {"glass",
       {{"uroughness", ".3"}, {"vroughness", ".15"}, {"remaproughness", "false"}, {"Kr", "0 0 0"}},
       1.5f,
       60},
      {"glass", {{"uroughness", "0.3"}, {"Kt", "0 0 0"}, {"Kr", "0.2 0.3 1"}}, 1.5f, 60},
      {"glass", {{"uroughness", "0.3"}, {"eta", "1"}}},
      {"glass", {{"Kr", "0.5 1 1"}, {"Kt", "1 0.2 0.2"}, {"eta", "0.8"}}},
      {"uber", {{"Kr", "0.2 0.2 0.2"}, {"Kt", "0.2 0.1 0.3"}, {"opacity", "0.5 0.7 1"}}},
      {"uber", {{"opacity", "0 0 0"}}},
      {"uber", {{"uroughness", "0.1"}, {"vroughness", "0.5"}, {"index", "2.5"}}},
      {"substrate", {{"uroughness", "0.2"}, {"vroughness", "0.6"}}},
      {"substrate", {{"Ks", "0 0 0"}}},
      {"substrate", {{"Kd", "0 0 0"}, {"Ks", "0.05 0.05 0.05"}, {"uroughness", "0.02"}}, 1.5f, 20},
      {"translucent", {{"reflect", "0 0 0"}, {"roughness", "0.4"}}, 1.5f, 40},
      {"translucent", {{"transmit", "0 0 0"}, {"Ks", "0.6 0.6 0.6"}}},
      {"mix", {{"namedmaterial1", "diffuse"}, {"namedmaterial2", "coat"}, {"amount", "0.3 0.5 1"}}},
      {"mix", {{"namedmaterial1", "rough glass"}, {"namedmaterial2", "coat"}}, 1.5f, 60},
      {"mix", {{"namedmaterial1", "mirror"}, {"namedmaterial2", "diffuse"}, {"amount", "0 0 0"}}},
      {"disney", {{"color", "0.9 0.5 0.1"}, {"metallic", "0.7"}, {"anisotropic", "0.8"}}, 1.5f, 30},
      {"disney", {{"sheen", "0.5"}, {"clearcoat", "1"}, {"clearcoatgloss", "0"}}, 1.5f, 40},
      {"disney", {{"spectrans", "0.8"}, {"eta", "1.4"}, {"speculartint", "1"}}, 1.4f, 40},
      {"disney", {{"spectrans", "1"}, {"eta", "1"}, {"color", "1 1 1"}}},
      {"disney",
       {{"thin", "true"}, {"spectrans", ".4"}, {"difftrans", ".8"}, {"flatness", ".6"}},
       1.5f,
       40},
      {"hair", {{"sigma_a", "0 0 0"}, {"beta_m", "0.5"}, {"beta_n", "1"}, {"alpha", "0"}}},
      {"hair", {{"color", "0.9 0.5 0.1"}, {"beta_m", "1"}, {"beta_n", "0.4"}, {"eta", "1.3"}}},
      {"mix", {{"namedmaterial1", "hair"}, {"namedmaterial2", "diffuse"}}},
      {"disney", {{"scatterdistance", "1 0.5 0.1"}, {"sheen", "0.3"}}},
      {"subsurface", {{"uroughness", "0.3"}, {"vroughness", "0.3"}, {"eta", "1.5"}}, 1.5f, 40},
      {"kdsubsurface", {{"Kr", "0 0 0"}, {"Kd", "@checks"}}},
      {"disney", {{"color", "@checks"}, {"roughness", "@half"}, {"sheentint", "1"}}},
  };
  for (MaterialCase& c : variants) describe(c);
  all.insert(all.end(), variants.begin(), variants.end());
  return all;
}

MaterialFixture::MaterialFixture(const MaterialCase& c) {
  build_.textures.addFloat("half", [](const SurfaceInteraction&) { return 0.5f; });
  build_.textures.addFloat("nan", [](const SurfaceInteraction&) { return std::nanf(""); });
  build_.textures.addRgb(
      "nan colour", [](const SurfaceInteraction&) { return Rgb(std::nanf(""), -1, kInfinity); });
  build_.textures.addRgb("checks", [](const SurfaceInteraction& at) {
    return at.uv.x < 0.5f ? Rgb(0.8f, 0.1f, 0.1f) : Rgb(0.2f, 0.9f, 0.1f);
  });
  const std::vector<std::pair<std::string, MaterialCase>> named = {
      {"diffuse", {"matte", {{"Kd", "0.7 0.7 0.2"}}}},
      {"mirror", {"mirror", {}}},
      {"coat", {"substrate", {{"uroughness", "0.3"}}}},
      {"rough glass", {"glass", {{"uroughness", "0.2"}, {"vroughness", "0.4"}}}},
      {"hair", {"hair", {}}},
      {"skin", {"disney", {{"scatterdistance", "1 0.5 0.2"}}}},
      {"everything", {"uber", {{"Kr", "1 1 1"}, {"Kt", "1 1 1"}, {"opacity", "0 0 0"}}}},
      {"bumpy", {"matte", {{"bumpmap", "@half"}}}},
  };
  for (const auto& [name, material] : named) {
    named_.push_back(create(material));
    build_.materials.add(name, named_.back().get());
  }
  build_.materials.add("nothing", nullptr);
  material_ = create(c);
}

std::unique_ptr<Material> MaterialFixture::create(const MaterialCase& c) {
  const auto& plugin = materialRegistry().get(c.plugin, {});
  return plugin.create(TestParameters(plugin.schema, c.parameters).set(), build_.materialContext());
}

void MaterialFixture::evaluate(Bsdf& bsdf) const {
  SurfaceInteraction at = tiltedSurface();
  material_->evaluate(at, bsdf);
}

SurfaceInteraction tiltedSurface() {
  SurfaceInteraction at;
  at.p = Vec3(3, -2, 1);
  at.uv = Vec2(0.7f, 0.2f);
  at.dpdu = at.shading.dpdu = Vec3(2, 0.5f, -1);
  at.dpdv = at.shading.dpdv = Vec3(0.5f, 3, 1);
  at.n = at.shading.n = normalize(cross(at.dpdu, at.dpdv));
  at.wo = at.n;
  return at;
}

Vec3 outgoing(const Bsdf& bsdf, float degrees, float azimuth) {
  const float theta = radians(degrees);
  return normalize(
      bsdf.frame().toWorld(sphericalDirection(std::sin(theta), std::cos(theta), radians(azimuth))));
}

}  // namespace lampyris::test
