// SPDX-License-Identifier: Apache-2.0
#include "scene/parser.h"

#include <gtest/gtest.h>

#include "scene_test.h"

namespace lampyris::test {
namespace {

using Floats = std::vector<float>;

Floats floats(const Parameter& p) { return {p.floats.begin(), p.floats.end()}; }

/// The parameters of `Film "image" …`.
struct Film {
  explicit Film(const std::string& parameters)
      : d(r.parse("Film \"image\" " + parameters + " WorldBegin WorldEnd")) {}
  const Parameter& operator[](const std::string& name) const {
    const Parameter* p = d.film.parameters.find(name);
    if (!p) throw std::runtime_error("no parameter " + name);
    return *p;
  }
  Reader r;
  Description d;
};

TEST(Parser, EveryParameterType) {
  const Film f(
      "\"integer i\" [1 -2 3.0] \"float f\" 2.5 \"bool b\" \"true\" \"bool c\" false "
      "\"string s\" [\"x\" \"y z\"] \"point p\" [1 2 3 4 5 6] \"point2 p2\" [1 2] "
      "\"vector v\" [1 2 3] \"vector2 v2\" [1 2] \"normal n\" [0 0 1] \"rgb r\" [.1 .2 .3] "
      "\"color col\" [1 1 1] \"xyz x\" [1 2 3] \"spectrum sp\" [400 1 700 2] "
      "\"spectrum file\" \"a.spd\" \"blackbody bb\" [3000 1] \"texture t\" \"tex\" "
      "\"point3 p3\" [1 2 3] \"vector3 v3\" [1 2 3] \"normal3 n3\" [1 2 3] \"float none\" []");
  EXPECT_EQ(std::vector<int32_t>(f["i"].integers.begin(), f["i"].integers.end()),
            (std::vector<int32_t>{1, -2, 3}));
  EXPECT_EQ(f["i"].type, ParameterType::Integer);
  EXPECT_EQ(floats(f["f"]), Floats{2.5f});
  EXPECT_EQ(f["b"].strings[0], "true");
  EXPECT_EQ(f["c"].strings[0], "false");
  ASSERT_EQ(f["s"].strings.size(), 2u);
  EXPECT_EQ(f["s"].strings[1], "y z");
  EXPECT_EQ(floats(f["p"]), (Floats{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(f["p"].type, ParameterType::Point3);
  EXPECT_EQ(f["p3"].type, ParameterType::Point3);
  EXPECT_EQ(f["p2"].type, ParameterType::Point2);
  EXPECT_EQ(f["v"].type, ParameterType::Vector3);
  EXPECT_EQ(f["v3"].type, ParameterType::Vector3);
  EXPECT_EQ(f["v2"].type, ParameterType::Vector2);
  EXPECT_EQ(f["n"].type, ParameterType::Normal);
  EXPECT_EQ(f["n3"].type, ParameterType::Normal);
  EXPECT_EQ(f["r"].type, ParameterType::Rgb);
  EXPECT_EQ(f["col"].type, ParameterType::Rgb);
  EXPECT_EQ(f["x"].type, ParameterType::Xyz);
  EXPECT_EQ(f["sp"].type, ParameterType::Spectrum);
  EXPECT_EQ(floats(f["sp"]), (Floats{400, 1, 700, 2}));
  EXPECT_EQ(f["file"].strings[0], "a.spd");
  EXPECT_EQ(f["bb"].type, ParameterType::Blackbody);
  EXPECT_EQ(f["t"].type, ParameterType::Texture);
  EXPECT_EQ(f["t"].strings[0], "tex");
  EXPECT_TRUE(f["none"].floats.empty());
  EXPECT_TRUE(f.r.warnings.empty());
}

TEST(Parser, OddSpacing) {
  const Film f("\"color  L \"[1 2 3]\"point to \"[ 4 5 6 ]# comment\n\t\"  float\ta\"7\r\n");
  EXPECT_EQ(floats(f["L"]), (Floats{1, 2, 3}));
  EXPECT_EQ(floats(f["to"]), (Floats{4, 5, 6}));
  EXPECT_EQ(floats(f["a"]), Floats{7});
  const Film escaped(R"("string filename" "a\\b\"c")");
  EXPECT_EQ(escaped["filename"].strings[0], "a\\b\"c");
}

TEST(Parser, LocationsAreExact) {
  const Film f("\"float a\" 1\n  \"float b\" 2");
  const auto a = f.r.files.position(f["a"].location), b = f.r.files.position(f["b"].location);
  EXPECT_EQ(a.line, 1);
  EXPECT_EQ(a.column, 14);
  EXPECT_EQ(b.line, 2);
  EXPECT_EQ(b.column, 3);
  EXPECT_EQ(f.r.files.position(f.d.film.parameters.location).column, 1);
}

TEST(Parser, LongListsStayWhole) {
  std::string text = "\"float a\" [";
  for (int i = 0; i < 300'000; ++i) text += std::to_string(i % 1000) + " ";
  const Film f(text + "] \"float b\" [1 2]");
  ASSERT_EQ(f["a"].floats.size(), 300'000u);
  for (size_t i = 0; i < 300'000; ++i) ASSERT_EQ(f["a"].floats[i], static_cast<float>(i % 1000));
  EXPECT_EQ(floats(f["b"]), (Floats{1, 2}));
}

TEST(Parser, OptionsAndDefaults) {
  Reader r;
  const Description d = r.parse(
      "Accelerator \"kdtree\" \"integer x\" 3 Sampler \"halton\" Integrator \"path\" PixelFilter "
      "\"box\" Camera \"perspective\" TransformTimes .25 .75 WorldBegin WorldEnd");
  EXPECT_EQ(d.accelerator.name, "kdtree");
  EXPECT_EQ(d.sampler.name, "halton");
  EXPECT_EQ(d.integrator.name, "path");
  EXPECT_EQ(d.filter.name, "box");
  EXPECT_EQ(d.transformTimes[0], .25f);
  EXPECT_EQ(d.transformTimes[1], .75f);
  EXPECT_FALSE(d.film.parameters.location.known());
  EXPECT_EQ(d.materials[0].plugin.name, "matte");
}

const Transform& shapeTransform(const Description& d, size_t shape = 0) {
  return d.transforms[d.shapes[shape].transform].start;
}

void expectPoint(const Vec3& got, const Vec3& want) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(got[i], want[i], 1e-5f) << i;
}

TEST(Parser, TransformsApplyFromTheRight) {
  Reader r;
  const Description d = r.parse(
      "WorldBegin Translate 1 2 3 Scale 2 3 4 Rotate 90 0 0 1 Shape \"sphere\"\n"
      "Transform [1 0 0 0 0 2 0 0 0 0 1 0 5 6 7 1] Shape \"sphere\"\n"
      "ConcatTransform [1 0 0 0 0 1 0 0 0 0 1 0 1 1 1 1] Shape \"sphere\"\n"
      "Identity Shape \"sphere\" Transform [2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 2] Shape \"sphere\"");
  expectPoint(shapeTransform(d, 0).point({1, 0, 0}), {1, 5, 3});
  expectPoint(shapeTransform(d, 1).point({1, 1, 1}), {6, 8, 8});
  expectPoint(shapeTransform(d, 2).point({1, 1, 1}), {7, 10, 9});
  EXPECT_TRUE(shapeTransform(d, 3).isIdentity());
  EXPECT_TRUE(shapeTransform(d, 4).isIdentity());
}

TEST(Parser, CameraAndCoordinateSystems) {
  Reader r;
  const Description d = r.parse(
      "LookAt 0 0 5 0 0 0 0 1 0 Camera \"perspective\" WorldBegin Shape \"a\" "
      "CoordSysTransform \"camera\" Shape \"b\" CoordinateSystem \"mine\" "
      "CoordSysTransform \"world\" Shape \"c\" AttributeBegin Translate 1 1 1 "
      "CoordinateSystem \"inner\" AttributeEnd CoordSysTransform \"inner\" Shape \"d\"");
  EXPECT_TRUE(shapeTransform(d, 0).isIdentity());
  // The camera's place in the world.
  expectPoint(shapeTransform(d, 1).point({0, 0, 0}), {0, 0, 5});
  expectPoint(d.transforms[d.cameraTransform].start.point({0, 0, 5}), {0, 0, 0});
  EXPECT_TRUE(shapeTransform(d, 2).isIdentity());
  // Coordinate systems outlive the block that defines them.
  expectPoint(shapeTransform(d, 3).point({0, 0, 0}), {1, 1, 1});
}

TEST(Parser, ActiveTransforms) {
  Reader r;
  const Description d = r.parse(
      "WorldBegin ActiveTransform StartTime Translate 1 0 0 ActiveTransform EndTime Translate 2 0 "
      "0 "
      "Shape \"a\" ActiveTransform All Translate 0 1 0 Shape \"b\" "
      "TransformBegin ActiveTransform StartTime TransformEnd Identity Shape \"c\"");
  const TransformPair& a = d.transforms[d.shapes[0].transform];
  EXPECT_TRUE(a.isAnimated());
  expectPoint(a.start.point({0, 0, 0}), {1, 0, 0});
  expectPoint(a.end.point({0, 0, 0}), {2, 0, 0});
  const TransformPair& b = d.transforms[d.shapes[1].transform];
  expectPoint(b.start.point({0, 0, 0}), {1, 1, 0});
  expectPoint(b.end.point({0, 0, 0}), {2, 1, 0});
  // TransformEnd gives back which transforms are active.
  EXPECT_FALSE(d.transforms[d.shapes[2].transform].isAnimated());
}

TEST(Parser, EqualTransformsAreOne) {
  Reader r;
  const Description d = r.parse(
      "WorldBegin Translate 1 0 0 LightSource \"point\" LightSource \"point\" AttributeBegin "
      "Translate 1 0 0 Translate -1 0 0 LightSource \"point\" AttributeEnd LightSource \"point\" "
      "Identity LightSource \"point\"");
  EXPECT_EQ(d.transforms.size(), 2u);
  for (size_t i = 0; i < 4; ++i) EXPECT_EQ(d.lights[i].transform, 1u);
  EXPECT_EQ(d.lights[4].transform, 0u);
}

TEST(Parser, AttributeBlocksSaveTheState) {
  Reader r;
  const Description d = r.parse(
      "WorldBegin Material \"a\" AttributeBegin Material \"b\" AreaLightSource \"diffuse\" "
      "ReverseOrientation MediumInterface \"in\" \"out\" Translate 1 0 0 Shape \"x\" AttributeEnd "
      "Shape \"y\" ObjectBegin \"o\" Material \"c\" ReverseOrientation Shape \"z\" ObjectEnd "
      "Shape \"w\" TransformBegin Material \"d\" Translate 1 0 0 TransformEnd Shape \"v\"");
  ASSERT_EQ(d.shapes.size(), 5u);
  const auto material = [&d](size_t i) { return d.materials[d.shapes[i].material].plugin.name; };
  EXPECT_EQ(material(0), "b");
  EXPECT_EQ(d.shapes[0].areaLight, 0u);
  EXPECT_TRUE(d.shapes[0].reverseOrientation);
  EXPECT_EQ(d.mediumInterfaces[d.shapes[0].mediumInterface].outside, "out");
  EXPECT_EQ(material(1), "a");
  EXPECT_EQ(d.shapes[1].areaLight, kNone);
  EXPECT_FALSE(d.shapes[1].reverseOrientation);
  EXPECT_EQ(d.shapes[1].mediumInterface, kNone);
  EXPECT_EQ(d.shapes[1].transform, 0u);
  EXPECT_EQ(material(2), "c");
  EXPECT_EQ(material(3), "a");
  EXPECT_FALSE(d.shapes[3].reverseOrientation);
  // TransformBegin saves nothing but transforms.
  EXPECT_EQ(material(4), "d");
  EXPECT_EQ(d.shapes[4].transform, 0u);
}

TEST(Parser, NamesEndWithTheirBlock) {
  Reader r;
  const Description d = r.parse(
      "WorldBegin MakeNamedMaterial \"m\" \"string type\" \"outer\" Texture \"t\" \"float\" \"o\" "
      "AttributeBegin MakeNamedMaterial \"m\" \"string type\" \"inner\" "
      "Texture \"t\" \"float\" \"i\" Texture \"t\" \"color\" \"s\" "
      "NamedMaterial \"m\" Shape \"a\" AttributeEnd NamedMaterial \"m\" Shape \"b\" WorldEnd");
  EXPECT_EQ(d.materials[d.shapes[0].material].plugin.name, "inner");
  EXPECT_EQ(d.materials[d.shapes[1].material].plugin.name, "outer");
  const auto texture = [&d](const NameIndex& names, size_t shape) {
    const uint32_t i = names.find("t", d.shapes[shape].order);
    return i == kNone ? "none" : d.textures[i].plugin.name;
  };
  EXPECT_EQ(texture(d.floatTextureNames, 0), "i");
  EXPECT_EQ(texture(d.floatTextureNames, 1), "o");
  EXPECT_EQ(texture(d.spectrumTextureNames, 0), "s");
  EXPECT_EQ(texture(d.spectrumTextureNames, 1), "none");
  ASSERT_EQ(r.warnings.size(), 2u);
  EXPECT_NE(r.warnings[0].find("named material \"m\" is defined again"), std::string::npos);
  EXPECT_NE(r.warnings[1].find("texture \"t\" is defined again"), std::string::npos);
}

TEST(Parser, ObjectsAndInstances) {
  Reader r;
  const Description d = r.parse(
      "WorldBegin Translate 1 0 0 ObjectBegin \"a\" Shape \"x\" Translate 0 1 0 Shape \"y\" "
      "ObjectEnd Shape \"z\" Translate 0 0 1 ObjectInstance \"a\" ObjectBegin \"a\" ObjectEnd "
      "ObjectInstance \"a\"");
  ASSERT_EQ(d.objects.size(), 2u);
  EXPECT_EQ(d.objects[0].firstShape, 0u);
  EXPECT_EQ(d.objects[0].lastShape, 2u);
  expectPoint(shapeTransform(d, 1).point({0, 0, 0}), {1, 1, 0});
  expectPoint(shapeTransform(d, 2).point({0, 0, 0}), {1, 0, 0});
  EXPECT_EQ(d.instances[0].object, 0u);
  expectPoint(d.transforms[d.instances[0].transform].start.point({0, 0, 0}), {1, 0, 1});
  // An object that is defined again is another one from there on.
  EXPECT_EQ(d.instances[1].object, 1u);
  EXPECT_EQ(d.objects[1].firstShape, d.objects[1].lastShape);
}

TEST(Parser, NamedPluginsLoseTheirType) {
  Reader r;
  const Description d = r.parse(
      "MakeNamedMedium \"m\" \"float g\" .5 \"string type\" \"homogeneous\" MediumInterface \"m\" "
      "WorldBegin MakeNamedMaterial \"a\" \"float x\" 1 \"string type\" \"metal\" \"float y\" 2");
  EXPECT_EQ(d.media[0].plugin.name, "homogeneous");
  EXPECT_EQ(d.media[0].plugin.parameters.parameters.size(), 1u);
  EXPECT_EQ(d.mediumInterfaces[0].inside, "m");
  EXPECT_EQ(d.mediumInterfaces[0].outside, "m");
  const ParameterSet& set = d.materials[1].plugin.parameters;
  ASSERT_EQ(set.parameters.size(), 2u);
  EXPECT_EQ(set.parameters[0].name, "x");
  EXPECT_EQ(set.parameters[1].name, "y");
}

TEST(Parser, Includes) {
  const TemporaryFolder folder;
  folder.write("sub/a.pbrt", "Shape \"a\" Include \"sub/b.pbrt\"\n");
  folder.write("sub/b.pbrt", "Shape \"b\" Translate 1 0 0");
  Reader r;
  const Description d =
      r.parse("WorldBegin Include \"sub/a.pbrt\" Shape \"c\" Include \"sub/b.pbrt\" WorldEnd",
              folder.path());
  ASSERT_EQ(d.shapes.size(), 4u);
  EXPECT_EQ(d.shapes[1].plugin.name, "b");
  EXPECT_EQ(d.shapes[2].plugin.name, "c");
  EXPECT_NE(d.shapes[2].transform, 0u);
  // A file that is included twice is opened once.
  EXPECT_EQ(d.shapes[1].plugin.parameters.location.file,
            d.shapes[3].plugin.parameters.location.file);
}

TEST(Parser, WarnsOfUnfinishedFiles) {
  Reader r;
  r.parse("WorldBegin\nAttributeBegin\nShape \"a\"");
  ASSERT_EQ(r.warnings.size(), 2u);
  EXPECT_EQ(r.warnings[0], "s:3:10: warning: the file ends without WorldEnd");
  EXPECT_EQ(r.warnings[1], "s:2:1: warning: AttributeBegin is not closed before WorldEnd");
  Reader more;
  more.parse("WorldBegin WorldEnd\nFilm \"image\"");
  ASSERT_EQ(more.warnings.size(), 1u);
  EXPECT_EQ(more.warnings[0],
            "s:2:1: warning: what follows WorldEnd is ignored: a file is "
            "rendered to one image");
}

TEST(Parser, ObjectLeftOpenKeepsItsShapes) {
  Reader r;
  const Description d = r.parse("WorldBegin ObjectBegin \"o\" Shape \"a\"");
  EXPECT_EQ(d.objects[0].lastShape, 1u);
}

TEST(NameIndex, SkipsEndedDefinitions) {
  NameIndex names;
  names.add("t", 0, 1);
  for (uint32_t i = 1; i < 100; ++i) {
    const size_t open = names.openCount();
    names.add("t", i, 10 * i);
    names.close(open, 10 * i + 5);
  }
  EXPECT_EQ(names.find("t", 1), kNone);
  EXPECT_EQ(names.find("t", 2), 0u);
  for (uint32_t i = 1; i < 100; ++i) {
    EXPECT_EQ(names.find("t", 10 * i), 0u);
    EXPECT_EQ(names.find("t", 10 * i + 1), i);
    EXPECT_EQ(names.find("t", 10 * i + 5), 0u);
  }
  EXPECT_EQ(names.find("u", 50), kNone);
}

}  // namespace
}  // namespace lampyris::test
