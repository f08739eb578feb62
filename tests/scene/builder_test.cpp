// SPDX-License-Identifier: Apache-2.0
#include "scene/builder.h"

#include <gtest/gtest.h>

#include "scene_test.h"

namespace lampyris::test {
namespace {

constexpr const char* kTriangle =
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point P\" [0 0 0 1 0 0 0 1 0] ";

/// A tiny film, the given world.
std::string world(const std::string& content) {
  return "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 4\nWorldBegin\n" +
         content + "\nWorldEnd\n";
}

TEST(Builder, DefaultsRenderAnEmptyWorld) {
  Reader r;
  const auto job = r.build("WorldBegin WorldEnd");
  EXPECT_EQ(job->film->resolution(), Int2(1280, 720));
  EXPECT_TRUE(job->camera && job->sampler && job->integrator && job->scene.geometry);
  EXPECT_EQ(job->scene.lightTable.size(), 0u);
  EXPECT_FALSE(job->scene.bounds.empty());
  EXPECT_TRUE(r.warnings.empty()) << r.warnings[0];
}

TEST(Builder, EveryRegistryIsListedOnce) {
  std::vector<std::string> kinds;
  for (const RegistryInfo* info : allRegistries()) {
    EXPECT_EQ(std::count(kinds.begin(), kinds.end(), info->kind()), 0) << info->kind();
    kinds.push_back(info->kind());
  }
  EXPECT_EQ(kinds.size(), 13u);
}

TEST(Builder, LightsHaveTheFilesOrder) {
  Reader r;
  const auto job = r.build(world(
      std::string("LightSource \"point\" \"point from\" [1 0 0]\n"
                  "AttributeBegin AreaLightSource \"diffuse\" ") +
      kTriangle + kTriangle +
      "AttributeEnd LightSource \"point\" \"rgb I\" [0 0 0] LightSource \"point\" \"point from\" "
      "[2 0 0] Translate 3 0 0 LightSource \"point\""));
  const LightTable& table = job->scene.lightTable;
  ASSERT_EQ(table.size(), 5u);
  EXPECT_EQ(table[0].light->bounds(0)->box.min.x, 1);
  EXPECT_FALSE(table[1].light->isDelta());
  EXPECT_FALSE(table[2].light->isDelta());
  EXPECT_EQ(table[3].light->bounds(0)->box.min.x, 2);
  EXPECT_EQ(table[4].light->bounds(0)->box.min.x, 3);
  EXPECT_EQ(r.statistics.value("scene", "lights dropped (no power)"), 1);
  EXPECT_EQ(r.statistics.value("scene", "lights"), 5);
  EXPECT_EQ(r.statistics.value("scene", "triangles"), 2);
}

TEST(Builder, PrimitivesKnowTheirLight) {
  Reader r;
  const auto job =
      r.build(world(std::string("LightSource \"point\" AreaLightSource \"diffuse\" ") + kTriangle));
  const Ray ray{{.2f, .2f, 5}, {0, 0, -1}};
  const auto hit = job->scene.geometry->intersect(ray);
  ASSERT_TRUE(hit);
  const Primitive& p = job->scene.geometry->primitive(*hit);
  EXPECT_EQ(p.lightId(hit->element), 1u);
  EXPECT_EQ(p.light, job->scene.lightTable[1].light);
  EXPECT_NE(p.material, nullptr);
}

TEST(Builder, EmitterWithoutPowerIsAnOrdinarySurface) {
  Reader r;
  const auto job =
      r.build(world(std::string("AreaLightSource \"diffuse\" \"rgb L\" [0 0 0] ") + kTriangle));
  const auto hit = job->scene.geometry->intersect({{.2f, .2f, 5}, {0, 0, -1}});
  ASSERT_TRUE(hit);
  EXPECT_EQ(job->scene.geometry->primitive(*hit).light, nullptr);
  EXPECT_EQ(job->scene.lightTable.size(), 0u);
}

TEST(Builder, InfiniteLightsAreListed) {
  Reader r;
  const auto job = r.build(world(std::string("LightSource \"distant\" LightSource \"infinite\" "
                                             "LightSource \"infinite\" \"rgb L\" [0 0 0] ") +
                                 kTriangle));
  ASSERT_EQ(job->scene.infiniteLights.size(), 1u);
  EXPECT_EQ(job->scene.infiniteLightIds[0], 1u);
  EXPECT_EQ(job->scene.lightTable.size(), 2u);
}

TEST(Builder, BackgroundOfAnEmptySceneIsSeen) {
  Reader r;
  const auto job = r.build(world("LightSource \"infinite\""));
  ASSERT_EQ(job->scene.infiniteLights.size(), 1u);
  EXPECT_FALSE(job->scene.infiniteLights[0]->escaped({0, 0, 1}).isBlack());
}

TEST(Builder, InstancesArePlacedAndCountInTheBounds) {
  Reader r;
  const auto job = r.build(
      world(std::string("ObjectBegin \"unused\" Shape \"nosuchshape\" ObjectEnd ObjectBegin \"o\" "
                        "Translate 0 0 1 AreaLightSource \"diffuse\" ") +
            kTriangle +
            "ObjectEnd Translate 10 0 0 ObjectInstance \"o\" Translate 10 0 0 "
            "ObjectInstance \"o\""));
  EXPECT_NEAR(job->scene.bounds.min.x, 10, 1e-4);
  EXPECT_NEAR(job->scene.bounds.max.x, 21, 1e-4);
  const auto hit = job->scene.geometry->intersect({{20.2f, .2f, 5}, {0, 0, -1}});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->shape.t, 4, 1e-4);
  const Primitive& p = job->scene.geometry->primitive(*hit);
  EXPECT_NE(p.light, nullptr);
  EXPECT_EQ(p.firstLight, kNoLight);
  EXPECT_EQ(job->scene.lightTable.size(), 0u);
  ASSERT_EQ(r.warnings.size(), 1u);
  EXPECT_NE(r.warnings[0].find("area light in an object"), std::string::npos);
  EXPECT_EQ(r.statistics.value("scene", "shapes skipped (of unused objects)"), 1);
}

TEST(Builder, MaterialsAreSharedUnlessAShapeReplacesAParameter) {
  Reader r;
  const auto job = r.build(
      world(std::string("Material \"nosuchmaterial\" MakeNamedMaterial \"unused\" \"string type\" "
                        "\"nosuchmaterial\" Material \"matte\" ") +
            kTriangle + kTriangle + kTriangle + "\"rgb Kd\" [1 0 0] Material \"\" " + kTriangle +
            "Material \"none\" " + kTriangle));
  EXPECT_EQ(job->scene.materials.size(), 2u);
  EXPECT_TRUE(r.warnings.empty()) << r.warnings[0];
}

TEST(Builder, MixFindsNamedMaterialsOfItsPlace) {
  const std::string named =
      "MakeNamedMaterial \"a\" \"string type\" \"mirror\" MakeNamedMaterial \"b\" \"string type\" "
      "\"matte\" ";
  const std::string mix =
      "Material \"mix\" \"string namedmaterial1\" \"a\" \"string namedmaterial2\" \"b\" ";
  Reader r;
  EXPECT_EQ(r.build(world(named + mix + kTriangle))->scene.materials.size(), 3u);
  EXPECT_NE(
      buildError(world(mix + named + kTriangle)).find("named material \"a\" is not defined here"),
      std::string::npos);
  // A mixture cannot contain itself: its name begins to hold after it.
  EXPECT_NE(buildError(world("MakeNamedMaterial \"m\" \"string type\" \"mix\" \"string "
                             "namedmaterial1\" \"m\" \"string namedmaterial2\" \"m\" "
                             "NamedMaterial \"m\" " +
                             std::string(kTriangle)))
                .find("named material \"m\" is not defined here"),
            std::string::npos);
  std::string deep = "MakeNamedMaterial \"m\" \"string type\" \"matte\"\n";
  for (int i = 0; i < 2000; ++i)
    deep +=
        "MakeNamedMaterial \"m\" \"string type\" \"mix\" \"string namedmaterial1\" \"m\" "
        "\"string namedmaterial2\" \"m\"\n";
  EXPECT_NE(buildError(world(deep + "NamedMaterial \"m\" " + kTriangle)).find("500 levels"),
            std::string::npos);
}

TEST(Builder, TexturesAreBuiltWhenUsed) {
  Reader r;
  const auto job = r.build(world(
      std::string("Texture \"unused\" \"spectrum\" \"imagemap\" \"string filename\" \"no.png\" "
                  "Texture \"t\" \"spectrum\" \"constant\" \"rgb value\" [1 0 0] Material "
                  "\"matte\" \"texture Kd\" \"t\" ") +
      kTriangle + kTriangle));
  EXPECT_EQ(job->scene.spectrumTextures.size(), 1u);
  EXPECT_NE(buildError(world("Texture \"t\" \"float\" \"constant\" Material \"matte\" \"texture "
                             "Kd\" \"t\" " +
                             std::string(kTriangle)))
                .find("unknown spectrum texture \"t\": there is a float texture of that name"),
            std::string::npos);
  EXPECT_NE(buildError(world("Texture \"stripes\" \"color\" \"constant\" Material \"matte\" "
                             "\"texture Kd\" \"stripe\" " +
                             std::string(kTriangle)))
                .find("unknown spectrum texture \"stripe\"; did you mean \"stripes\"?"),
            std::string::npos);
}

TEST(Builder, AlphaIsATextureOrZero) {
  const auto alphaOf = [](const std::string& parameters) {
    Reader r;
    const auto job = r.build(world("Texture \"t\" \"float\" \"constant\" \"float value\" 1 " +
                                   std::string(kTriangle) + parameters));
    const auto hit = job->scene.geometry->intersect({{.2f, .2f, 5}, {0, 0, -1}});
    if (!hit) return std::string("passed");
    const Primitive& p = job->scene.geometry->primitive(*hit);
    return std::string(p.alpha ? "alpha" : "") + (p.shadowAlpha ? "shadow" : "");
  };
  EXPECT_EQ(alphaOf(""), "");
  EXPECT_EQ(alphaOf("\"texture alpha\" \"t\""), "alpha");
  EXPECT_EQ(alphaOf("\"texture shadowalpha\" \"t\""), "shadow");
  EXPECT_EQ(alphaOf("\"float alpha\" .5"), "");
  EXPECT_EQ(alphaOf("\"float alpha\" 0"), "passed");
  EXPECT_EQ(alphaOf("\"float shadowalpha\" 0"), "shadow");
}

TEST(Builder, SpectrumFilesAreRead) {
  const TemporaryFolder folder;
  folder.write("spds/flat.spd", "# flat\n400 2 # at 400 nm\n700 2\n");
  folder.write("odd.spd", "400 2 700");
  folder.write("text.spd", "400 two");
  const auto lightPower = [&folder](const std::string& intensity) {
    Reader r;
    return r.build(world("LightSource \"point\" \"spectrum I\" " + intensity), {}, folder.path())
        ->scene.lightTable[0]
        .light->power(0);
  };
  EXPECT_EQ(lightPower("\"spds/flat.spd\""), lightPower("[400 2 700 2]"));
  const auto error = [&folder](const std::string& file) {
    return buildError(world("LightSource \"point\" \"spectrum I\" " + file), {}, folder.path());
  };
  EXPECT_EQ(error("\"odd.spd\""),
            "1:10: a spectrum file holds pairs of a wavelength and a value, "
            "this one 3 numbers");
  EXPECT_EQ(error("\"text.spd\""), "1:5: expected a wavelength or a value, got \"two\"");
  EXPECT_NE(error("\"missing.spd\"").find("missing.spd"), std::string::npos);
  EXPECT_EQ(error("\"missing.spd\"").substr(0, 6), "3:21: ");
  EXPECT_EQ(error("[\"odd.spd\" \"text.spd\"]"),
            "3:21: parameter \"I\": expected one spectrum file, got 2");
}

TEST(Builder, WarnsOnceOfWhatIsNotRenderedYet) {
  Reader r;
  r.build(
      world("ActiveTransform EndTime Translate 1 0 0 LightSource \"point\" LightSource "
            "\"point\""));
  ASSERT_EQ(r.warnings.size(), 1u);
  EXPECT_NE(r.warnings[0].find("this stands where it is at the start time"), std::string::npos);
}

TEST(Builder, NamesOfPbrtThatAreNotThereYet) {
  const std::string text = world(
      std::string("Texture \"t\" \"color\" \"ptex\" Material \"matte\" \"texture Kd\" \"t\" ") +
      kTriangle);
  EXPECT_EQ(
      buildError(text),
      "3:1: \"ptex\" is a pbrt-v3 texture that Lampyris cannot read: no Debian package has the "
      "Ptex library; bake the texture to an image and use \"imagemap\"");
}

TEST(Builder, AreaLightsWithTwoSourcesOfLight) {
  const std::string t = kTriangle;
  const std::string texture = "Texture \"glow\" \"color\" \"constant\" ";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {world(texture + "\nAreaLightSource \"diffuse\" \"rgb L\" [1 1 1] \"texture L\" \"glow\" " +
             t),
       "4:43: the area light has L as a colour and as a texture: give one of them, and \"scale\" "
       "as "
       "a factor"},
      {world(texture +
             "\nAreaLightSource \"diffuse\" \"texture L\" \"glow\" \"string filename\" \"a.exr\" " +
             t),
       "4:1: the area light has both a \"texture L\" and a \"filename\": give one of them "
       "(\"scale\" works with either)"},
      {world("AreaLightSource \"diffuse\" \"texture L\" \"glow\" " + t),
       "3:27: unknown spectrum texture \"glow\""},
  };
  for (const auto& [text, error] : cases) EXPECT_EQ(buildError(text), error) << text;
}

TEST(Builder, UnknownNames) {
  const std::string t = kTriangle;
  const std::vector<std::pair<std::string, std::string>> cases = {
      {world("\nShape \"spher\""), "4:1: unknown shape \"spher\"; did you mean \"sphere\"?"},
      {world("Material \"mate\" " + t), "3:1: unknown material \"mate\"; did you mean \"matte\"?"},
      {world("LightSource \"pont\""), "3:1: unknown light \"pont\"; did you mean \"point\"?"},
      {world("AreaLightSource \"difuse\" " + t),
       "3:1: unknown area light \"difuse\"; did you mean \"diffuse\"?"},
      {"Sampler \"haltn\" " + world(""),
       "1:1: unknown sampler \"haltn\"; did you mean \"halton\"?"},
      {"PixelFilter \"bx\" " + world(""), "1:1: unknown filter \"bx\"; did you mean \"box\"?"},
      {"Integrator \"pth\" " + world(""),
       "1:1: unknown integrator \"pth\"; did you mean \"path\"?"},
      {"Integrator \"path\" \"string lightsampler\" \"bvhh\" " + world(""),
       "1:19: unknown lightsampler \"bvhh\"; did you mean \"bvh\"?"},
      {"Integrator \"path\" \"integer maxdept\" 3 " + world(""),
       "1:19: unknown parameter \"maxdept\" for integrator \"path\"; did you mean \"maxdepth\"?"},
      {world("Shape \"sphere\" \"float radus\" 3"),
       "3:16: unknown parameter \"radus\" for shape \"sphere\"; did you mean \"radius\"?"},
      {"Integrator \"path\" \"float maxdepth\" 3 " + world(""),
       "1:19: parameter \"maxdepth\": expected integer, got float"},
  };
  for (const auto& [text, error] : cases) EXPECT_EQ(buildError(text), error) << text;
}

BuildOptions with(std::vector<std::pair<std::string, std::string>> overrides) {
  BuildOptions o;
  o.overrides = std::move(overrides);
  return o;
}

TEST(Overrides, ReplaceParameters) {
  Reader r;
  const auto job = r.build(world(""), with({{"film.xresolution", "16"},
                                            {"film.filename", "other.exr"},
                                            {"integrator.maxdepth", "2"},
                                            {"camera.fov", "20"},
                                            {"filter.xwidth", "1"},
                                            {"integrator.lightsampler", "power"}}));
  EXPECT_EQ(job->film->resolution(), Int2(16, 4));
  EXPECT_EQ(job->film->filename(), "other.exr");
  EXPECT_EQ(job->film->filter().radius().x, 1);
}

TEST(Overrides, ReplacePlugins) {
  Reader r;
  const std::string options =
      "Sampler \"halton\" \"integer pixelsamples\" 4 \"bool samplepixelcenter\" \"false\" "
      "Integrator \"path\" \"float rrthreshold\" 2 ";
  const auto job =
      r.build(options + world(""), with({{"sampler", "random"}, {"integrator", "directlighting"}}));
  EXPECT_EQ(job->sampler->samplesPerPixel(), 4);
  EXPECT_TRUE(r.warnings.empty()) << r.warnings[0];
  r.build(world("LightSource \"point\" LightSource \"point\""), with({{"lightsampler", "power"}}));
  r.build(world(""), with({{"filter", "gaussian"}, {"filter.alpha", "3"}}));
}

TEST(Overrides, SamplesSeedOutputAndCrop) {
  BuildOptions o;
  o.samplesPerPixel = 3;
  o.outputPath = "x.pfm";
  o.cropWindow = {0, .5f, .5f, 1};
  Reader r;
  const auto job = r.build(world(""), o);
  EXPECT_EQ(job->sampler->samplesPerPixel(), 3);
  EXPECT_EQ(job->film->filename(), "x.pfm");
  EXPECT_EQ(job->film->bounds(), (PixelBounds{{0, 2}, {4, 4}}));
}

TEST(Overrides, Errors) {
  const auto error = [](const std::string& key, const std::string& value) {
    return buildError(world(""), with({{key, value}}));
  };
  EXPECT_EQ(
      error("integator.maxdepth", "3"),
      "-D integator.maxdepth: unknown kind \"integator\"; did you mean \"integrator\"?; it is "
      "one of integrator, sampler, film, camera, filter, lightsampler");
  EXPECT_EQ(error("film.", "3"), "-D film.: expected kind.parameter=value or kind=plugin");
  EXPECT_EQ(error("film.xresolutio", "3")
                .find("-D film.xresolutio: unknown parameter; did you mean \"xresolution\"?; there "
                      "are: xresolution, yresolution"),
            0u);
  EXPECT_EQ(error("film.xresolution", "3.5"), "-D xresolution: \"3.5\" is not an integer");
  EXPECT_EQ(error("sampler", "rndom"), "unknown sampler \"rndom\"; did you mean \"random\"?");
  EXPECT_EQ(error("lightsampler", "bvhh"), "unknown lightsampler \"bvhh\"; did you mean \"bvh\"?");
  EXPECT_NE(error("lightsampler.nosuch", "1").find("unknown parameter"), std::string::npos);
}

TEST(Builder, ManyLightsLoad) {
  std::string content;
  for (int i = 0; i < 100'000; ++i)
    content +=
        fmt::format("LightSource \"point\" \"point from\" [ {} {} {} ] \"color I\" [ 1 {} 1 ]\n",
                    i % 317, i % 101, i / 1000, i % 7);
  Reader r;
  const auto job = r.build(world(content + kTriangle));
  ASSERT_EQ(job->scene.lightTable.size(), 100'000u);
  for (const LightId id : {0u, 1u, 54'321u, 99'999u}) {
    const Vec3 p = job->scene.lightTable[id].light->bounds(0)->box.min;
    EXPECT_EQ(p, Vec3(id % 317, id % 101, id / 1000));
  }
}

/// Of several faults the first of the file is reported, whatever thread finds it.
TEST(Builder, ReportsTheFirstFault) {
  std::string content;
  for (int i = 0; i < 5000; ++i)
    content += fmt::format("LightSource \"point\" \"float {}\" 1\n", i < 700 ? "scal" : "I");
  content.insert(0, "LightSource \"point\"\n");
  for (int i = 0; i < 5; ++i)
    EXPECT_EQ(buildError(world(content)),
              "4:21: unknown parameter \"scal\" for light \"point\"; did you mean \"scale\"?");
}

TEST(Builder, DamagedScenesOnlyThrow) {
  const std::string scene =
      "Film \"image\" \"integer xresolution\" [8] \"integer yresolution\" [4]\nLookAt 0 0 5 0 0 0 "
      "0 "
      "1 0 Camera \"perspective\" \"float fov\" 40 Integrator \"path\" WorldBegin LightSource "
      "\"spot\" \"point from\" [0 0 1] \"point to\" [0 0 0] AreaLightSource \"diffuse\" Shape "
      "\"sphere\" Material "
      "\"plastic\" \"rgb Kd\" [1 0 0] " +
      std::string(kTriangle) + "WorldEnd\n";
  ASSERT_EQ(buildError(scene), "");
  size_t errors = 0;
  for (size_t i = 0; i < scene.size(); ++i) {
    std::vector<std::string> damaged = {scene.substr(0, i)};
    for (const char c : {'\0', '"', '7', '-', 'x'}) {
      damaged.push_back(scene);
      damaged.back()[i] = c;
    }
    for (const std::string& text : damaged) {
      // A damaged size may be a valid one that takes long to build.
      if (i > 12 && i < 80) continue;
      Reader r;
      try {
        r.build(text);
      } catch (const SceneError&) {
        ++errors;
      } catch (const IoError&) {
        ++errors;
      }
    }
  }
  EXPECT_GT(errors, scene.size());
}

}  // namespace
}  // namespace lampyris::test
