// SPDX-License-Identifier: Apache-2.0
// Every message of the parser with its place.
#include <gtest/gtest.h>

#include "scene_test.h"

namespace lampyris::test {
namespace {

struct Case {
  std::string text, error;
};

void expectErrors(const std::vector<Case>& cases) {
  for (const Case& c : cases) EXPECT_EQ(parseError(c.text), c.error) << c.text;
}

TEST(ParserError, Directives) {
  expectErrors({
      {"WorldBegin\n  Shap \"sphere\"", "2:3: unknown directive \"Shap\"; did you mean \"Shape\"?"},
      {"Qwertz", "1:1: unknown directive \"Qwertz\""},
      {"worldbegin", "1:1: unknown directive \"worldbegin\"; did you mean \"WorldBegin\"?"},
      {"WorldBegin 3", "1:12: expected a directive, got \"3\""},
      {"WorldBegin ]", "1:12: expected a directive, got ]"},
      {"\"abc\"", "1:1: expected a directive, got the string \"abc\""},
      {"\"abc", "1:1: string without closing quote"},
      {"\x1f\x8b\x08 gzip", "1:1: unexpected byte 0x1f: a scene file is plain text"},
      {"Sha\xffpe", "1:1: unexpected byte 0xff: a scene file is plain text"},
      {std::string("\0", 1), "1:1: unexpected byte 0x00: a scene file is plain text"},
      {"",
       "1:1: the file has no WorldBegin: shapes and lights stand between WorldBegin and "
       "WorldEnd"},
      {"Film \"image\"\n",
       "2:1: the file has no WorldBegin: shapes and lights stand between "
       "WorldBegin and WorldEnd"},
  });
}

TEST(ParserError, Blocks) {
  expectErrors({
      {"Shape \"sphere\"", "1:1: Shape must stand after WorldBegin"},
      {"AttributeBegin", "1:1: AttributeBegin must stand after WorldBegin"},
      {"WorldEnd", "1:1: WorldEnd must stand after WorldBegin"},
      {"WorldBegin\nFilm \"image\"", "2:1: Film must stand before WorldBegin"},
      {"WorldBegin\nWorldBegin", "2:1: WorldBegin must stand before WorldBegin"},
      {"WorldBegin AttributeEnd", "1:12: AttributeEnd without AttributeBegin"},
      {"WorldBegin TransformEnd", "1:12: TransformEnd without TransformBegin"},
      {"WorldBegin ObjectEnd", "1:12: ObjectEnd without ObjectBegin"},
      {"WorldBegin\nTransformBegin\nAttributeEnd",
       "3:1: AttributeEnd does not match the TransformBegin in line 2"},
      {"WorldBegin ObjectBegin \"a\"\nAttributeEnd",
       "2:1: AttributeEnd does not match the ObjectBegin in line 1"},
      {"WorldBegin ObjectBegin \"a\"\nAttributeBegin ObjectEnd",
       "2:16: ObjectEnd does not match the AttributeBegin in line 2"},
      {"WorldBegin ObjectBegin \"a\" ObjectBegin \"b\"",
       "1:28: ObjectBegin inside of object \"a\": objects do not nest"},
      {"WorldBegin ObjectBegin \"a\" ObjectInstance \"a\"",
       "1:28: ObjectInstance inside of an object: objects do not nest"},
      {"WorldBegin ObjectBegin \"tree\" ObjectEnd ObjectInstance \"tre\"",
       "1:41: unknown object \"tre\"; did you mean \"tree\"?"},
      {"WorldBegin ObjectBegin 3",
       "1:24: ObjectBegin expects the object's name in quotes, got "
       "\"3\""},
  });
  std::string deep = "WorldBegin ";
  for (int i = 0; i < 10'001; ++i) deep += "AttributeBegin ";
  EXPECT_EQ(parseError(deep), "1:150012: blocks are nested deeper than 10000 levels");
}

TEST(ParserError, Transforms) {
  expectErrors({
      {"Translate 1 2", "1:14: Translate expects 3 numbers, got the end of the file after 2"},
      {"Translate 1 2 x", "1:15: Translate expects 3 numbers, got \"x\" after 2"},
      {"Translate [1 2 3 4]", "1:18: Translate expects ] after 3 numbers, got \"4\""},
      {"Rotate 1 2 \"3\"", "1:12: Rotate expects 4 numbers, got the string \"3\" after 2"},
      {"Rotate 1 0 0 0", "1:1: Rotate needs an axis other than 0 0 0"},
      {"Scale 1 0 1", "1:1: Scale by 0 leaves nothing to see"},
      {"LookAt 0 0 0 0 0 0 0 1 0",
       "1:1: LookAt needs an eye and a target that differ, and an up "
       "vector across the line of sight"},
      {"LookAt 0 0 0 0 1 0 0 1 0",
       "1:1: LookAt needs an eye and a target that differ, and an up "
       "vector across the line of sight"},
      {"Transform [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0]",
       "1:41: Transform expects 16 numbers, got ] after 15"},
      {"Transform [1 0 0 0 0 0 0 0 0 0 1 0 0 0 0 1]",
       "1:1: Transform by a matrix that has no inverse"},
      {"ConcatTransform [1 0 0 1 0 1 0 0 0 0 1 0 0 0 0 1]",
       "1:1: ConcatTransform by a projective matrix: its 4th, 8th and 12th numbers must be 0, its "
       "16th must not"},
      {"CoordSysTransform \"here\"", "1:1: unknown coordinate system \"here\""},
      {"CoordinateSystem \"here\" CoordSysTransform \"hera\"",
       "1:25: unknown coordinate system \"hera\"; did you mean \"here\"?"},
      {"ActiveTransform Start",
       "1:17: ActiveTransform expects StartTime, EndTime or All, got \"Start\""},
      {"ActiveTransform",
       "1:16: ActiveTransform expects StartTime, EndTime or All, got the end "
       "of the file"},
      {"Translate 1e39 0 0", "1:11: \"1e39\" is too large: numbers go to 3.4e38"},
      {"Scale 1e30 1 1 Scale 1e30 1 1 Camera \"perspective\"",
       "1:31: the current transform has no inverse (a scale of 0, or numbers too large)"},
  });
}

TEST(ParserError, Parameters) {
  const std::string s = "Film \"image\" ";
  expectErrors({
      {"Film image", "1:6: Film expects a type in quotes, got \"image\""},
      {"Film", "1:5: Film expects a type in quotes, got the end of the file"},
      {s + "\"xresolution\" 3", "1:14: expected a parameter's \"type name\", got \"xresolution\""},
      {s + "\"\" 3", "1:14: expected a parameter's \"type name\", got \"\""},
      {s + "\"float a b\" 3", "1:14: expected a parameter's \"type name\", got \"float a b\""},
      {s + "\"flot a\" 3", "1:14: unknown parameter type \"flot\"; did you mean \"float\"?"},
      {s + "\"float a\"", "1:23: parameter \"a\": expected a number, got the end of the file"},
      {s + "\"float a\" \"3\"", "1:24: parameter \"a\": expected a number, got the string \"3\""},
      {s + "\"float a\" WorldBegin",
       "1:24: parameter \"a\": expected a number, got \"WorldBegin\""},
      {s + "\"float a\" [1 2", "1:24: parameter \"a\": [ without ]"},
      {s + "\"float a\" [1 WorldBegin",
       "1:27: parameter \"a\": expected a number or ], got \"WorldBegin\""},
      {s + "\"float a\" [1 \"b\"]",
       "1:27: parameter \"a\": expected a number or ], got the string \"b\""},
      {s + "\"float a\" [[1]]", "1:25: parameter \"a\": expected a number or ], got ["},
      {s + "\"float a\" 1e", "1:24: \"1e\" is not a number"},
      {s + "\"integer a\" 1.5", "1:26: expected an integer, got \"1.5\""},
      {s + "\"integer a\" @SPP@", "1:26: parameter \"a\": expected a number, got \"@SPP@\""},
      {s + "\"point a\" [1 2 3 4]",
       "1:14: parameter \"a\": 4 values do not divide into points of 3 numbers"},
      {s + "\"vector2 a\" [1 2 3]",
       "1:14: parameter \"a\": 3 values do not divide into vector2s of 2 numbers"},
      {s + "\"rgb a\" [1 2]",
       "1:14: parameter \"a\": 2 values do not divide into rgbs of 3 numbers"},
      {s + "\"blackbody a\" 3000",
       "1:14: parameter \"a\": 1 values do not divide into blackbodys of a temperature and a "
       "scale"},
      {s + "\"spectrum a\" [400 1 500]",
       "1:14: parameter \"a\": 3 values do not divide into spectrums of a wavelength and a value"},
      {s + "\"string a\" 3", "1:25: parameter \"a\": expected a quoted string, got \"3\""},
      {s + "\"string a\" [\"b\" c]",
       "1:30: parameter \"a\": expected a quoted string or ], got \"c\""},
      {s + "\"bool a\" \"yes\"",
       "1:23: parameter \"a\": expected \"true\" or \"false\", got \"yes\""},
      {s + "\"bool a\" 1", "1:23: parameter \"a\": expected \"true\" or \"false\", got \"1\""},
      {s + "\"string a\" \"b\\q\"",
       "1:25: unknown escape \\q in a string; a backslash is written \\\\"},
      {s + "\"float a\" 1 2", "1:26: expected a directive, got \"2\""},
  });
}

TEST(ParserError, Names) {
  expectErrors({
      {"WorldBegin MakeNamedMaterial \"a\" \"float sigma\" 3",
       "1:12: MakeNamedMaterial needs a parameter \"string type\" that names the material"},
      {"MakeNamedMedium \"a\"",
       "1:1: MakeNamedMedium needs a parameter \"string type\" that names the medium"},
      {"WorldBegin NamedMaterial \"steel\"", "1:12: unknown named material \"steel\""},
      {"WorldBegin MakeNamedMaterial \"steel\" \"string type\" \"metal\" NamedMaterial \"stel\"",
       "1:60: unknown named material \"stel\"; did you mean \"steel\"?"},
      {"WorldBegin AttributeBegin MakeNamedMaterial \"a\" \"string type\" \"metal\" AttributeEnd "
       "NamedMaterial \"a\"",
       "1:84: named material \"a\" ended with its AttributeBegin block"},
      {"WorldBegin Texture \"t\" \"colour\" \"constant\"",
       "1:24: a texture is of type \"float\", \"spectrum\" or \"color\", not \"colour\""},
      {"Include 3", "1:9: Include expects a file name in quotes, got \"3\""},
  });
}

TEST(ParserError, Includes) {
  const TemporaryFolder folder;
  folder.write("self.pbrt", "Include \"self.pbrt\"");
  folder.write("a.pbrt", "Include \"b.pbrt\"");
  folder.write("b.pbrt", "\n Include \"./a.pbrt\"");
  const std::string missing = parseError("\nInclude \"missing.pbrt\"", folder.path());
  EXPECT_EQ(missing.substr(0, 5), "2:1: ");
  EXPECT_NE(missing.find("missing.pbrt"), std::string::npos);
  EXPECT_EQ(parseError("Include \"self.pbrt\"", folder.path()),
            "1:1: \"" + folder.path() + "/self.pbrt\" includes itself");
  EXPECT_EQ(parseError("Include \"a.pbrt\"", folder.path()),
            "2:2: \"" + folder.path() + "/a.pbrt\" includes itself");
  for (int i = 0; i < 70; ++i)
    folder.write(fmt::format("d{}.pbrt", i), fmt::format("Include \"d{}.pbrt\"", i + 1));
  EXPECT_EQ(parseError("Include \"d0.pbrt\"", folder.path()),
            "1:1: files are included deeper than 64 levels");
}

/// A scene with every kind of token, cut off or damaged at every byte, gives an error or a scene.
TEST(ParserError, DamagedScenesOnlyThrow) {
  const std::string scene =
      "\xef\xbb\xbf# c\nLookAt 0 -5.5 2.6  0 0 .75  0 0 1\r\nFilm \"image\" \"integer a\" [96] "
      "\"string f\" [\"a\\\\b\"]\nWorldBegin\nAttributeBegin AreaLightSource \"diffuse\" \"color  "
      "L \" [9 8.5 8]\nTransformBegin Rotate 1 2 3 4 TransformEnd Shape \"m\" \"bool b\" \"true\" "
      "\"texture t\" \"x\" AttributeEnd ObjectBegin \"o\" ObjectEnd ObjectInstance \"o\" "
      "MakeNamedMaterial \"n\" \"string type\" \"matte\" NamedMaterial \"n\" WorldEnd\n";
  ASSERT_EQ(parseError(scene), "");
  size_t errors = 0;
  for (size_t i = 0; i < scene.size(); ++i) {
    std::vector<std::string> damaged = {scene.substr(0, i),
                                        scene.substr(0, i) + scene.substr(i + 1)};
    for (const char c : {'\0', '"', '[', ']', '#', '\n', '9', 'x', '\\', '-', '\xff'}) {
      damaged.push_back(scene);
      damaged.back()[i] = c;
    }
    for (const std::string& text : damaged) {
      Reader r;
      try {
        r.parse(text);
      } catch (const SceneError& e) {
        ++errors;
        EXPECT_LE(e.location.offset, text.size());
        EXPECT_STRNE(e.what(), "");
      }
    }
  }
  EXPECT_GT(errors, scene.size());
}

}  // namespace
}  // namespace lampyris::test
