// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <functional>
// jpeglib.h needs cstdio before it.
#include <jpeglib.h>

#include "core/image_formats.h"
#include "image_test_files.h"

namespace lampyris::test {

namespace {

struct Jpeg {
  int width = 0, height = 0;
  J_COLOR_SPACE colours = JCS_RGB;
  bool progressive = false, adobe = false;
};

/// A file in which every pixel has the bytes `pixel`.
std::string encode(const Jpeg& jpeg, const std::vector<unsigned char>& pixel) {
  jpeg_error_mgr errors;
  jpeg_compress_struct info;
  info.err = jpeg_std_error(&errors);
  jpeg_create_compress(&info);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&info, &bytes, &size);
  info.image_width = static_cast<JDIMENSION>(jpeg.width);
  info.image_height = static_cast<JDIMENSION>(jpeg.height);
  info.input_components = static_cast<int>(pixel.size());
  info.in_color_space = jpeg.colours;
  jpeg_set_defaults(&info);
  jpeg_set_quality(&info, 100, TRUE);
  info.write_Adobe_marker = jpeg.adobe ? TRUE : FALSE;
  if (jpeg.progressive) jpeg_simple_progression(&info);
  jpeg_start_compress(&info, TRUE);
  std::vector<unsigned char> row;
  for (int x = 0; x < jpeg.width; ++x) row.insert(row.end(), pixel.begin(), pixel.end());
  unsigned char* rows = row.data();
  while (info.next_scanline < info.image_height) jpeg_write_scanlines(&info, &rows, 1);
  jpeg_finish_compress(&info);
  std::string file(reinterpret_cast<const char*>(bytes), size);
  jpeg_destroy_compress(&info);
  std::free(bytes);
  return file;
}

/// Its middle pixel, in bytes.
Rgb middle(const std::string& bytes) {
  const LoadedImage loaded = readJpegImage("a.jpg", bytes);
  EXPECT_TRUE(loaded.srgbEncoded);
  return 255.f * loaded.image.rgb(loaded.image.width() / 2, loaded.image.height() / 2);
}

void expectNear(const Rgb& got, const Rgb& want) {
  EXPECT_NEAR(got.r, want.r, 1.5);
  EXPECT_NEAR(got.g, want.g, 1.5);
  EXPECT_NEAR(got.b, want.b, 1.5);
}

}  // namespace

TEST(ImageJpeg, EveryKindOfPixel) {
  for (const bool progressive : {false, true}) {
    const Jpeg rgb{.width = 19, .height = 11, .progressive = progressive};
    expectNear(middle(encode(rgb, {200, 90, 30})), Rgb(200, 90, 30));
    Jpeg grey = rgb;
    grey.colours = JCS_GRAYSCALE;
    const std::string bytes = encode(grey, {77});
    expectNear(middle(bytes), Rgb(77));
    const Image image = readJpegImage("a.jpg", bytes).image;
    EXPECT_EQ(image.channels(), 1);
    EXPECT_EQ(image.width(), 19);
    EXPECT_EQ(image.height(), 11);
  }
}

/// Inks 20, 60, 100 and black 51 of 255 leave (235, 195, 155) · 0.8 of white.
TEST(ImageJpeg, InksBecomeRgb) {
  const Jpeg plain{.width = 9, .height = 9, .colours = JCS_CMYK};
  expectNear(middle(encode(plain, {20, 60, 100, 51})), 0.8f * Rgb(235, 195, 155));
  Jpeg adobe = plain;
  adobe.adobe = true;
  expectNear(middle(encode(adobe, {235, 195, 155, 204})), 0.8f * Rgb(235, 195, 155));
}

TEST(ImageJpeg, FaultsAreErrors) {
  const std::string whole = encode({.width = 40, .height = 40, .progressive = true}, {9, 8, 7});
  const auto fault = [](const std::string& bytes) {
    return ioErrorOf([&] { readJpegImage("a.jpg", bytes); });
  };
  EXPECT_EQ(fault(whole), "");
  EXPECT_EQ(fault(whole.substr(0, whole.size() - 2)),
            "cannot read image \"a.jpg\": the file is truncated");
  const size_t size = whole.find("\xff\xc2") + 5;  // height, then width
  std::string other = whole;
  other.replace(size, 4, std::string("\x20\0\x20\0", 4));
  EXPECT_NE(fault(other).find("size is wrong"), std::string::npos);
  other.replace(size, 4, std::string(4, '\0'));
  EXPECT_NE(fault(other), "");
  other = whole;
  other[whole.find("\xff\xda") + 2] = '\x7f';  // the scan's header
  EXPECT_NE(fault(other), "");
  EXPECT_NE(fault("\xff\xd8"), "");
}

/// The name's ending says that it is an image, the contents which one.
TEST(ImageJpeg, IsKnownByItsFirstBytes) {
  const TemporaryFolder folder;
  writeBytes(folder / "a.png", encode({.width = 3, .height = 2}, {1, 2, 3}));
  EXPECT_EQ(readImageFile(folder / "a.png").image.width(), 3);
}

}  // namespace lampyris::test
