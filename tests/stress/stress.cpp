// SPDX-License-Identifier: Apache-2.0
#include "stress/stress.h"

#include <gtest/gtest.h>

#include <set>

#include "core/rejections.h"
#include "integrators/registry.h"
#include "lightdistributions/registry.h"
#include "support/resolvers.h"
#include "support/statistics.h"

namespace lampyris::test {
namespace {

std::string quoted(const std::string& name) { return "\"" + name + "\""; }

TinyView viewWith(const std::string& integrator) {
  TinyView v;
  v.integrator = integrator;
  return v;
}

/// All integrators but those of these names.
Views integratorsBut(const std::set<std::string>& left, const std::string& parameters) {
  Views views;
  for (const auto& e : integratorRegistry().entries()) {
    if (left.contains(e.name)) continue;
    views.push_back(viewWith(quoted(e.name) + " " + parameters));
    if (e.schema.find("bootstrapsamples"))
      views.back().integrator += " \"integer bootstrapsamples\" 4000";
  }
  return views;
}

void expectContractAt(const LightDistribution& d, const Scene& scene,
                      const LightSampleContext& at) {
  for (int i = 0; i < 64; ++i) {
    const auto s = d.sample(at, (static_cast<float>(i) + 0.5f) / 64);
    if (!s) continue;
    ASSERT_TRUE(s->pmf > 0 && s->pmf <= 1) << s->pmf;
    ASSERT_EQ(s->pmf, d.pmf(at, s->light));
  }
  const LightTable& lights = scene.lightTable;
  if (lights.size() > 10'000) return;
  double sum = 0;
  for (LightId id = 0; id < lights.size(); ++id) {
    const float pmf = d.pmf(at, id);
    sum += static_cast<double>(pmf);
    ASSERT_TRUE(pmf >= 0 && std::isfinite(pmf));
    const LightTable::Entry entry = lights[id];
    for (uint64_t i = 0; i < 8; ++i) {
      const auto s = entry.light->sample(entry.element, at.p, {uniform(3, i, 0), uniform(3, i, 1)});
      const bool counts = s && !(at.bsdf->f(at.wo, s->wi) * s->radiance).isBlack();
      ASSERT_TRUE(pmf > 0 || !counts) << "light " << id << " is lost";
    }
  }
  ASSERT_LE(sum, 1 + 1e-4);
}

}  // namespace

Views lightSamplerViews(const std::string& parameters) {
  Views views;
  for (const auto& e : lightDistributionRegistry().entries())
    views.push_back(
        viewWith("\"path\" \"string lightsampler\" " + quoted(e.name) + " " + parameters));
  return views;
}

Views directViews(const std::string& parameters) {
  return integratorsBut({"ambientocclusion"}, parameters);
}

Views pathViews(const std::string& parameters) {
  return integratorsBut({"ambientocclusion", "directlighting", "whitted", "sppm", "mlt"},
                        parameters);
}

Views operator+(Views a, const Views& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

void expectSound(TinyScene& scene) {
  EXPECT_EQ(scene.badSamples(), 0);
  for (size_t i = 0; i < kRejectionCount; ++i) {
    const char* const name = nameOf(static_cast<Rejection>(i));
    EXPECT_EQ(scene.statistics().value(kRejectionSection, name), 0) << name;
  }
  for (const Rgb& c : scene.pixels()) EXPECT_TRUE(c.isFinite() && c.r >= 0 && c.g >= 0 && c.b >= 0);
}

void expectRadiance(const TinyView& view, const std::string& text, const Expected& expected,
                    uint64_t samples) {
  SCOPED_TRACE(view.integrator);
  TinyScene scene(text);
  scene.render(samples);
  expectSound(scene);
  EXPECT_EQ(meanTest(scene.greens(), expected.radiance, expected.slack), "");
}

void expectLightContract(TinyScene& scene) {
  const Scene& s = scene.job().scene;
  CameraSample sample;
  sample.film = 0.5f * Vec2(scene.film().resolution());
  const CameraRay camera = scene.job().camera->generate(sample);
  const auto hit = s.geometry->intersect(camera.ray);
  ASSERT_TRUE(hit);
  SurfaceInteraction at = s.geometry->surface(camera.ray, *hit, SurfaceDetail::Full);
  Bsdf bsdf;
  at.primitive->material->evaluate(at, bsdf);
  const LightSampleContext context(at, bsdf);
  for (const auto& e : lightDistributionRegistry().entries()) {
    SCOPED_TRACE(e.name);
    TestBuild build;
    Statistics statistics;
    const auto d =
        e.create({}, LightDistributionContext{build.base(), s.lightTable, s.bounds, statistics});
    expectContractAt(*d, s, context);
  }
}

}  // namespace lampyris::test
