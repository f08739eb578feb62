// SPDX-License-Identifier: Apache-2.0
#include "core/image_layers.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/error.h"

namespace lampyris {
namespace {

std::string file(const std::string& name) { return testing::TempDir() + "lampyris_layers_" + name; }

TEST(ImageLayers, AreFoundByTheirName) {
  Image image(3, 2, 3);
  WriteOptions options;
  for (const char* channel : {"albedo.B", "albedo.G", "albedo.R", "N.X", "N.Y", "N.Z", "depth.Z"}) {
    const auto n = static_cast<float>(options.layers.size());
    options.layers.push_back({channel, std::vector<float>(6, n)});
  }
  const std::string path = file("a.exr");
  writeImageFile(path, image, options);
  EXPECT_EQ(exrLayerNames(path), (std::vector<std::string>{"N", "albedo", "depth"}));
  EXPECT_EQ(readExrLayer(path, "albedo").rgb(2, 1), Rgb(2, 1, 0));
  EXPECT_EQ(readExrLayer(path, "N").rgb(0, 0), Rgb(3, 4, 5));
  const Image depth = readExrLayer(path, "depth");
  EXPECT_EQ(depth.channels(), 1);
  EXPECT_EQ(depth.at(1, 1, 0), 6.f);
  try {
    readExrLayer(path, "normal");
    ADD_FAILURE();
  } catch (const IoError& e) {
    EXPECT_NE(std::string(e.what()).find("N, albedo, depth"), std::string::npos) << e.what();
  }
  std::filesystem::remove(path);
}

TEST(ImageLayers, FilesWithoutAny) {
  const std::string path = file("b.exr");
  writeImageFile(path, Image(2, 2, 3));
  EXPECT_TRUE(exrLayerNames(path).empty());
  EXPECT_THROW(readExrLayer(path, "albedo"), IoError);
  std::ofstream(path) << "no image";
  EXPECT_THROW(exrLayerNames(path), IoError);
  std::filesystem::remove(path);
  EXPECT_THROW(readExrLayer(path, "albedo"), IoError);
}

}  // namespace
}  // namespace lampyris
