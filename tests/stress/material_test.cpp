// SPDX-License-Identifier: Apache-2.0
/// Materials at the ends of their parameters, seen from above and along the surface.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "materials/registry.h"
#include "stress/double_bsdf.h"
#include "stress/stress.h"

namespace lampyris::test {
namespace {

const std::string kOneBounce = "\"integer maxdepth\" 1";
constexpr uint64_t kSamples = 64;
constexpr int kResolution = 8;
constexpr double kPaths = kResolution * kResolution * kSamples;
constexpr double kAngles[] = {0, 60, 85, 89, 89.9, 89.99};
/// pbrt-v3's least α.
constexpr double kLeastAlpha = 1e-3;

/// A wide plane of `material`, seen at an angle to its normal in degrees, under a white sky.
std::string plane(TinyView view, const std::string& material, double degrees, bool above = true) {
  const double angle = degrees * M_PI / 180;
  view.lookAt = fmt::format("{:.9g} 0 {:.9g}  0 0 0  0 1 0", 5 * std::sin(angle),
                            (above ? 5 : -5) * std::cos(angle));
  view.camera = R"("orthographic" "float screenwindow" [-1e-6 1e-6 -1e-6 1e-6])";
  view.resolution = kResolution;
  return tinyScene(view,
                   "LightSource \"infinite\" \"rgb L\" [1 1 1]\n" + material + "\n" + square(100));
}
double cosineOf(double degrees) {
  // Of the numbers in the file.
  const double angle = degrees * M_PI / 180;
  const double x = static_cast<float>(5 * std::sin(angle)),
               z = static_cast<float>(5 * std::cos(angle));
  return z / std::sqrt(x * x + z * z);
}

/// What samples of at most `most` can miss with a probability of 1e-9, because it is rare.
double rare(double most) { return 20 * most / kPaths; }

/// With two numbers of facets, whose difference says how far the quadrature is off.
template <class Albedo>
Expected quadrature(const Albedo& albedo, double most) {
  const double fine = albedo(200), coarse = albedo(100);
  return {fine, std::abs(fine - coarse) + 1e-4 * fine + rare(most)};
}

std::string rough(const std::string& name, double roughness, const std::string& rest) {
  const std::string r = fmt::format("{:.9g}", roughness);
  return "Material \"" + name + "\" \"bool remaproughness\" \"false\" \"float uroughness\" " + r +
         " \"float vroughness\" " + r + rest;
}

TEST(Roughness, MetalsReflectTheirShare) {
  const double eta = 0.25, k = 3.5;
  for (const double roughness : {0., 1e-45, 1e-38, 1e-7, 1e-3, 1e-2, 0.1, 0.5, 1.})
    for (const double degrees : kAngles) {
      SCOPED_TRACE(fmt::format("roughness {} at {}°", roughness, degrees));
      const Expected expected = quadrature(
          [&](int facets) {
            return metalAlbedo(cosineOf(degrees), std::max(roughness, kLeastAlpha), eta, k, facets);
          },
          1);
      const std::string metal =
          rough("metal", roughness, " \"rgb eta\" [.25 .25 .25] \"rgb k\" [3.5 3.5 3.5]");
      for (const TinyView& view : pathViews(kOneBounce))
        expectRadiance(view, plane(view, metal, degrees), expected, kSamples);
    }
}

/// Denormal roughnesses are no others than tiny ones, in every material.
TEST(Roughness, DenormalsAreTiny) {
  for (const auto& e : materialRegistry().entries()) {
    std::string names;
    const auto add = [&](const char* name, const std::string& value) {
      if (e.schema.find(name)) names += fmt::format(" \"float {}\" {}", name, value);
    };
    const auto image = [&](const std::string& roughness) {
      names = e.schema.find("remaproughness") ? " \"bool remaproughness\" \"false\"" : "";
      for (const char* name : {"roughness", "uroughness", "vroughness"}) add(name, roughness);
      TinyScene scene(plane({}, "Material \"" + e.name + "\"" + names, 60));
      scene.render(4);
      expectSound(scene);
      return scene.pixels();
    };
    if (!e.schema.find("roughness") && !e.schema.find("uroughness")) continue;
    SCOPED_TRACE(e.name);
    const auto tiny = image("1e-20");
    for (const char* roughness : {"1e-45", "1e-40", "1e-38"})
      EXPECT_EQ(image(roughness), tiny) << roughness;
  }
}

TEST(RefractiveIndex, GlassShowsTheSky) {
  const double least = std::nextafter(1.f, 2.f), most = std::nextafter(1.f, 0.f);
  for (const double eta : {1., least, most, 1.000001, 0.9999, 1.002, 0.99, 1.5, 0.4, 100., 0.01})
    for (const double roughness : {0., 1e-45, 0.3})
      for (const double degrees : kAngles) {
        // Facets in the few directions that see through are beyond the quadrature.
        if (roughness > 0 && eta < 0.1) continue;
        SCOPED_TRACE(fmt::format("index {}, roughness {} at {}°", eta, roughness, degrees));
        const double index = static_cast<float>(eta), cosine = cosineOf(degrees);
        const double through = 1 / (index * index);
        // So near to 1 facets bend nothing.
        const bool smooth = roughness == 0 || std::abs(index - 1) < 1e-3;
        Expected expected = quadrature(
            [&](int facets) {
              return glassAlbedo(cosine, std::max(roughness, kLeastAlpha), index, facets);
            },
            std::max(1., through));
        if (smooth) {
          const double r = dielectricFresnel(cosine, index);
          expected = {r + (1 - r) * through, rare(std::abs(1 - through)) + 1e-5};
        }
        const std::string glass =
            rough("glass", roughness, fmt::format(" \"float eta\" {:.9g}", eta));
        for (const TinyView& view : pathViews(kOneBounce))
          expectRadiance(view, plane(view, glass, degrees), expected, kSamples);
      }
}

TEST(RefractiveIndex, SmoothGlassMirrorsFresnelsShare) {
  for (const double eta : {1., 1.0000002, 0.9999997, 1.00001, 0.9999, 1.001, 1.5, 0.4, 100., 0.01})
    for (const double degrees : kAngles)
      for (const bool above : {true, false}) {
        SCOPED_TRACE(fmt::format("index {} at {}° {}", eta, degrees, above ? "above" : "below"));
        TinyView view;
        view.integrator = "\"whitted\"";  // follows both directions: no noise
        const std::string glass = rough("glass", 0, fmt::format(" \"float eta\" {:.9g}", eta)),
                          black =
                              fmt::format("\nAttributeBegin\nTranslate 0 0 {}\n", above ? -1 : 1) +
                              matte(0) + square(1e5f) + "AttributeEnd\n";
        const double index = static_cast<float>(eta);
        const double r = dielectricFresnel(cosineOf(degrees), above ? index : 1 / index);
        expectRadiance(view, plane(view, black + glass, degrees, above), {r, 1e-3 * r}, 1);
      }
}

}  // namespace
}  // namespace lampyris::test
