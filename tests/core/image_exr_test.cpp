// SPDX-License-Identifier: Apache-2.0
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"
#include "core/image.h"
#include "core/image_test_files.h"

namespace lampyris {
namespace {

using namespace test;

TEST(ExrImage, FloatRoundTripIsExact) {
  const TemporaryFolder folder;
  for (const int channels : {1, 2, 3, 4}) {
    Image image = gradient(13, 7, channels);
    image.at(12, 6, 0) = -1e30f;
    writeImageFile(folder / "a.exr", image);
    const LoadedImage loaded = readImageFile(folder / "a.exr");
    EXPECT_FALSE(loaded.srgbEncoded);
    EXPECT_EQ(loaded.image.channels(), channels);
    EXPECT_EQ(loaded.image.width(), 13);
    EXPECT_EQ(loaded.image.data(), image.data());
  }
}

TEST(ExrImage, HalfRoundsAndStaysFinite) {
  const TemporaryFolder folder;
  Image image = gradient(13, 7, 3);
  image.setRgb(0, 0, Rgb(1e9f, -1e9f, 0.5f));
  WriteOptions options;
  options.fullFloat = false;
  options.layers.push_back({"depth", std::vector<float>(13 * 7, 123456.789f)});
  writeImageFile(folder / "a.exr", image, options);
  const Image back = readImageFile(folder / "a.exr").image;
  EXPECT_EQ(back.rgb(0, 0), Rgb(65504, -65504, 0.5f));
  for (int y = 1; y < 7; ++y) {
    EXPECT_NEAR(back.at(5, y, 1), image.at(5, y, 1), 1e-3);
    EXPECT_NE(back.at(5, y, 1), image.at(5, y, 1));
  }
  const Imf::InputFile file((folder / "a.exr").c_str());
  EXPECT_EQ(file.header().channels().findChannel("R")->type, Imf::HALF);
  EXPECT_EQ(file.header().channels().findChannel("depth")->type, Imf::FLOAT);
}

TEST(ExrImage, LayersMetadataAndPlacement) {
  const TemporaryFolder folder;
  const Image image = gradient(4, 3, 3);
  WriteOptions options;
  options.metadata = {{"lampyris:seed", "7"}, {"comments", "a test"}};
  options.layers.push_back({"albedo.R", gradient(4, 3, 1).data()});
  options.placement = {{10, 20}, {100, 50}};
  writeImageFile(folder / "crop.exr", image, options);

  Imf::InputFile file((folder / "crop.exr").c_str());
  const Imf::Header& header = file.header();
  EXPECT_EQ(header.dataWindow(), Imath::Box2i({10, 20}, {13, 22}));
  EXPECT_EQ(header.displayWindow(), Imath::Box2i({0, 0}, {99, 49}));
  EXPECT_EQ(header.typedAttribute<Imf::StringAttribute>("lampyris:seed").value(), "7");
  std::vector<float> layer(12);
  Imf::FrameBuffer buffer;
  buffer.insert("albedo.R", Imf::Slice::Make(Imf::FLOAT, layer.data(), header.dataWindow(), 4, 16));
  file.setFrameBuffer(buffer);
  file.readPixels(20, 22);
  EXPECT_EQ(layer, options.layers[0].values);

  const Image back = readImageFile(folder / "crop.exr").image;
  EXPECT_EQ(back.width(), 4);
  EXPECT_EQ(back.data(), image.data());
}

TEST(ExrImage, BadLayersAndAttributesAreErrors) {
  const TemporaryFolder folder;
  const Image image = gradient(2, 2, 3);
  WriteOptions options;
  options.layers.push_back({"short", {1, 2, 3}});
  EXPECT_NE(ioErrorOf([&] { writeImageFile(folder / "a.exr", image, options); }), "");
  options.layers = {{"R", {1, 2, 3, 4}}};
  EXPECT_NE(ioErrorOf([&] { writeImageFile(folder / "a.exr", image, options); }), "");
  options.layers.clear();
  options.metadata = {{"channels", "mine"}};
  EXPECT_NE(ioErrorOf([&] { writeImageFile(folder / "a.exr", image, options); }), "");
  EXPECT_EQ(folder.fileCount(), 0u);
}

/// Writes one value per channel at (x, y): 10 y + x + 100 per channel, in the given type.
template <class File, class Value>
void writeChannels(File& file, Imf::PixelType type, const std::vector<std::string>& names,
                   const Imath::Box2i& window, std::vector<std::vector<Value>>& storage) {
  const int width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;
  Imf::FrameBuffer buffer;
  storage.resize(names.size());
  for (size_t c = 0; c < names.size(); ++c) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        storage[c].push_back(
            static_cast<Value>(static_cast<float>(10 * y + x) + 100 * static_cast<float>(c)));
    buffer.insert(names[c], Imf::Slice::Make(type, storage[c].data(), window, sizeof(Value),
                                             sizeof(Value) * static_cast<size_t>(width)));
  }
  file.setFrameBuffer(buffer);
}

Imf::Header headerOf(const Imath::Box2i& window, Imf::PixelType type,
                     const std::vector<std::string>& names) {
  Imf::Header header(Imath::Box2i({0, 0}, {99, 99}), window);
  for (const std::string& n : names) header.channels().insert(n, Imf::Channel(type));
  return header;
}

const Imath::Box2i kWindow({-3, 5}, {4, 10});

TEST(ExrImage, ReadsTiledHalf) {
  const TemporaryFolder folder;
  const std::vector<std::string> names = {"R", "G", "B", "A"};
  {
    Imf::Header header = headerOf(kWindow, Imf::HALF, names);
    header.setTileDescription(Imf::TileDescription(4, 4, Imf::ONE_LEVEL));
    Imf::TiledOutputFile file((folder / "a.exr").c_str(), header);
    std::vector<std::vector<Imath::half>> storage;
    writeChannels(file, Imf::HALF, names, kWindow, storage);
    file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
  }
  const Image image = readImageFile(folder / "a.exr").image;
  ASSERT_EQ(image.channels(), 4);
  ASSERT_EQ(image.width(), 8);
  ASSERT_EQ(image.height(), 6);
  EXPECT_EQ(image.at(0, 0, 0), 0);
  EXPECT_EQ(image.at(7, 5, 2), 257);
  EXPECT_EQ(image.at(2, 3, 3), 332);
}

TEST(ExrImage, ReadsUintDecreasingAndSingleChannels) {
  const TemporaryFolder folder;
  for (const std::string name : {"Y", "Z"}) {
    {
      Imf::Header header = headerOf(kWindow, Imf::UINT, {name});
      header.lineOrder() = Imf::DECREASING_Y;
      Imf::OutputFile file((folder / "a.exr").c_str(), header);
      std::vector<std::vector<uint32_t>> storage;
      writeChannels(file, Imf::UINT, {name}, kWindow, storage);
      file.writePixels(6);
    }
    const Image image = readImageFile(folder / "a.exr").image;
    ASSERT_EQ(image.channels(), 1);
    EXPECT_EQ(image.at(7, 0, 0), 7);
    EXPECT_EQ(image.at(1, 5, 0), 51);
  }
}

TEST(ExrImage, UnsupportedChannelsAreErrors) {
  const TemporaryFolder folder;
  const auto errorWith = [&](const std::vector<std::string>& names) {
    {
      Imf::Header header = headerOf(kWindow, Imf::FLOAT, names);
      Imf::OutputFile file((folder / "a.exr").c_str(), header);
      std::vector<std::vector<float>> storage;
      writeChannels(file, Imf::FLOAT, names, kWindow, storage);
      file.writePixels(6);
    }
    return ioErrorOf([&] { readImageFile(folder / "a.exr"); });
  };
  EXPECT_NE(errorWith({"diffuse.B", "diffuse.G"}).find("diffuse.B, diffuse.G"), std::string::npos);
  EXPECT_NE(errorWith({"Y", "RY", "BY"}).find("chroma"), std::string::npos);
  EXPECT_EQ(errorWith({"R", "depth"}), "");
  EXPECT_EQ(readImageFile(folder / "a.exr").image.rgb(1, 0), Rgb(1, 0, 0));
}

/// A header of one attribute more, of `size` bytes as it says itself, and a data window.
std::string header(const std::string& type, int32_t size, const std::string& value, int32_t width) {
  const auto integer = [](int32_t v) { return std::string(reinterpret_cast<const char*>(&v), 4); };
  const std::string zero(1, '\0');
  return "\x76\x2f\x31\x01" + integer(2) + "channels" + zero + "chlist" + zero + integer(19) + "R" +
         zero + integer(2) + integer(0) + integer(1) + integer(1) + zero + "dataWindow" + zero +
         "box2i" + zero + integer(16) + integer(0) + integer(0) + integer(width - 1) + integer(9) +
         "extra" + zero + type + zero + integer(size) + value + zero;
}

TEST(ExrImage, HeadersThatAskForMoreThanTheFileIsWorthAreErrors) {
  const TemporaryFolder folder;
  const auto errorOf = [&](const std::string& bytes) {
    writeBytes(folder / "a.exr", bytes);
    return ioErrorOf([&] { readImageFile(folder / "a.exr"); });
  };
  const std::string huge("\xff\xff\xff\x7f\xff\xff\xff\x7f");
  for (const char* type : {"nonsense", "string", "preview", "stringvector"})
    EXPECT_NE(errorOf(header(type, 1'936'286'720, "", 8)).find("header is damaged"),
              std::string::npos)
        << type;
  for (const char* type : {"preview", "stringvector", "float", "v3f", "chlist", "idmanifest"})
    EXPECT_NE(errorOf(header(type, 8, huge, 8)).find("header is damaged"), std::string::npos)
        << type;
  EXPECT_NE(errorOf(header("int", 4, "1234", 100'000)).find("size is wrong"), std::string::npos);
  EXPECT_NE(errorOf(header("int", 4, "1234", 8)), "");
}

TEST(ExrImage, UnfinishedFilesAreErrors) {
  const TemporaryFolder folder;
  {
    Imf::Header header = headerOf(Imath::Box2i({0, 0}, {15999, 15999}), Imf::FLOAT, {"R"});
    Imf::OutputFile file((folder / "a.exr").c_str(), header);
  }
  EXPECT_NE(ioErrorOf([&] { readImageFile(folder / "a.exr"); }).find("not finished"),
            std::string::npos);
  {
    Imf::Header header = headerOf(Imath::Box2i({0, 0}, {99999, 99999}), Imf::FLOAT, {"R"});
    Imf::OutputFile file((folder / "b.exr").c_str(), header);
  }
  EXPECT_NE(ioErrorOf([&] { readImageFile(folder / "b.exr"); }).find("more than"),
            std::string::npos);
}

}  // namespace
}  // namespace lampyris
