// SPDX-License-Identifier: Apache-2.0
#include "core/image.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <thread>

#include "core/error.h"
#include "core/hash.h"
#include "core/image_stb_memory.h"
#include "core/image_test_files.h"

namespace lampyris {
namespace {

using namespace test;

TEST(Image, GreyIsEveryChannel) {
  Image grey(1, 1, 2);
  grey.at(0, 0, 0) = 0.25f;
  grey.at(0, 0, 1) = 1;
  EXPECT_EQ(grey.rgb(0, 0), Rgb(0.25f));
  grey.setRgb(0, 0, Rgb(0, 1, 0));
  EXPECT_FLOAT_EQ(grey.at(0, 0, 0), 0.71516f);
  EXPECT_EQ(grey.at(0, 0, 1), 1);
}

TEST(Image, SrgbCurve) {
  EXPECT_EQ(srgbToLinear(0), 0);
  EXPECT_NEAR(srgbToLinear(1), 1, 1e-6);
  EXPECT_NEAR(srgbToLinear(0.5f), 0.2140411f, 1e-6);
  EXPECT_NEAR(srgbToLinear(0.02f), 0.02f / 12.92f, 1e-8);
  for (float v = 0; v <= 1; v += 0.01f) EXPECT_NEAR(linearToSrgb(srgbToLinear(v)), v, 1e-5);
}

TEST(Image, DecodingLeavesAlpha) {
  Image image(2, 1, 4);
  for (float& v : image.data()) v = 0.5f;
  image.at(1, 0, 0) = 128 / 255.f;
  decodeSrgb(image);
  EXPECT_FLOAT_EQ(image.at(0, 0, 0), srgbToLinear(0.5f));
  EXPECT_EQ(image.at(0, 0, 3), 0.5f);
  EXPECT_EQ(image.at(1, 0, 0), srgbToLinear(128 / 255.f));
}

class EightBit : public testing::TestWithParam<std::tuple<const char*, int>> {};

TEST_P(EightBit, RoundTrip) {
  const auto [ending, channels] = GetParam();
  const TemporaryFolder folder;
  const std::string path = folder / (std::string("image") + ending);
  const Image image = gradient(7, 5, channels);
  writeImageFile(path, image);
  const LoadedImage loaded = readImageFile(path);
  EXPECT_TRUE(loaded.srgbEncoded);
  ASSERT_EQ(loaded.image.width(), 7);
  ASSERT_EQ(loaded.image.height(), 5);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 7; ++x) {
      const Rgb stored = loaded.image.rgb(x, y), want = image.rgb(x, y);
      EXPECT_EQ(stored.r, std::floor(255 * linearToSrgb(want.r) + 0.5f) / 255);
      EXPECT_EQ(stored.b, std::floor(255 * linearToSrgb(want.b) + 0.5f) / 255);
      if (channels == 4) {
        EXPECT_EQ(loaded.image.at(x, y, 3), std::floor(255 * image.at(x, y, 3) + 0.5f) / 255);
      }
    }
  const Image linear = readLinearImage(path);
  EXPECT_EQ(linear.at(3, 2, 0), srgbToLinear(loaded.image.at(3, 2, 0)));
}
INSTANTIATE_TEST_SUITE_P(Formats, EightBit,
                         testing::Values(std::tuple(".png", 1), std::tuple(".png", 2),
                                         std::tuple(".png", 3), std::tuple(".PNG", 4),
                                         std::tuple(".tga", 1), std::tuple(".tga", 3),
                                         std::tuple(".Tga", 4), std::tuple(".bmp", 3)));

TEST(Image, JpgIsNearlyTheImage) {
  const TemporaryFolder folder;
  Image image(32, 32, 3);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) image.setRgb(x, y, Rgb(0.2f, static_cast<float>(y) / 40, 0.5f));
  for (const char* name : {"a.jpg", "a.JPEG"}) {
    writeImageFile(folder / name, image);
    const LoadedImage loaded = readImageFile(folder / name);
    EXPECT_TRUE(loaded.srgbEncoded);
    for (int y = 0; y < 32; ++y)
      EXPECT_NEAR(loaded.image.at(16, y, 1), linearToSrgb(image.at(16, y, 1)), 0.03);
  }
}

TEST(Image, EightBitClamps) {
  const TemporaryFolder folder;
  Image image(3, 1, 1);
  image.at(0, 0, 0) = -2;
  image.at(1, 0, 0) = 5;
  image.at(2, 0, 0) = std::numeric_limits<float>::quiet_NaN();
  writeImageFile(folder / "a.png", image);
  const Image back = readImageFile(folder / "a.png").image;
  EXPECT_EQ(back.at(0, 0, 0), 0);
  EXPECT_EQ(back.at(1, 0, 0), 1);
  EXPECT_EQ(back.at(2, 0, 0), 0);
}

TEST(Image, HdrKeepsSharedExponentPrecision) {
  const TemporaryFolder folder;
  Image image = gradient(40, 9, 3);
  image.setRgb(0, 0, Rgb(1000, 2, 1e4f));
  image.setRgb(1, 0, Rgb(-1, 0, std::numeric_limits<float>::quiet_NaN()));
  writeImageFile(folder / "a.hdr", image);
  const LoadedImage loaded = readImageFile(folder / "a.hdr");
  EXPECT_FALSE(loaded.srgbEncoded);
  ASSERT_EQ(loaded.image.width(), 40);
  EXPECT_EQ(loaded.image.rgb(1, 0), Rgb(0));
  for (int y = 0; y < 9; ++y)
    for (int x = 2; x < 40; ++x) {
      const Rgb want = image.rgb(x, y), got = loaded.image.rgb(x, y);
      EXPECT_NEAR(got.g, want.g, want.maxComponent() / 100);
    }
  EXPECT_NEAR(loaded.image.rgb(0, 0).b, 1e4f, 100);
}

TEST(Image, PfmRoundTripIsExact) {
  const TemporaryFolder folder;
  for (const int channels : {1, 3}) {
    Image image = gradient(5, 3, channels);
    image.at(0, 0, 0) = -1e30f;
    writeImageFile(folder / "a.pfm", image);
    const LoadedImage loaded = readImageFile(folder / "a.pfm");
    EXPECT_FALSE(loaded.srgbEncoded);
    EXPECT_EQ(loaded.image.channels(), channels);
    EXPECT_EQ(loaded.image.data(), image.data());
  }
}

TEST(Image, PfmByteOrdersAndScale) {
  const TemporaryFolder folder;
  // Two rows of one pixel; the file starts with the lower one. 1.0f is 3f800000.
  writeBytes(folder / "big.pfm", std::string("Pf\n1 2\n1.0\n\x3f\x80\0\0\x40\0\0\0", 19));
  writeBytes(folder / "little.pfm", std::string("Pf 1 2 -3\n\0\0\x80\x3f\0\0\0\x40", 18));
  const Image big = readImageFile(folder / "big.pfm").image;
  EXPECT_EQ(big.at(0, 0, 0), 2);
  EXPECT_EQ(big.at(0, 1, 0), 1);
  const Image little = readImageFile(folder / "little.pfm").image;
  EXPECT_EQ(little.at(0, 0, 0), 6);
  EXPECT_EQ(little.at(0, 1, 0), 3);
}

// PNG files by hand: what stb cannot write.
std::string bigEndian(uint32_t v) {
  std::string s;
  for (const int shift : {24, 16, 8, 0}) s += static_cast<char>(v >> shift & 255);
  return s;
}
std::string pngChunk(const std::string& typeAndData) {
  uint32_t crc = ~0u;
  for (const char c : typeAndData) {
    crc ^= static_cast<unsigned char>(c);
    for (int k = 0; k < 8; ++k) crc = crc & 1 ? 0xedb88320u ^ (crc >> 1) : crc >> 1;
  }
  return bigEndian(static_cast<uint32_t>(typeAndData.size() - 4)) + typeAndData + bigEndian(~crc);
}
std::string png(uint32_t width, uint32_t height, char bits, char colourType,
                const std::string& rows) {
  uint32_t a = 1, b = 0;
  for (const char c : rows) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  const auto length = static_cast<uint16_t>(rows.size());
  std::string stored("\x78\x01\x01", 3);
  for (const int n : {length & 255, length >> 8, ~length & 255, ~length >> 8 & 255})
    stored += static_cast<char>(n);
  stored += rows + bigEndian(b << 16 | a);
  std::string header = "IHDR" + bigEndian(width) + bigEndian(height) + bits + colourType;
  header += std::string(3, '\0');
  return "\x89PNG\r\n\x1a\n" + pngChunk(header) + pngChunk("IDAT" + stored) + pngChunk("IEND");
}

TEST(Image, SixteenBitPng) {
  const TemporaryFolder folder;
  writeBytes(folder / "grey.png", png(2, 1, 16, 0, std::string("\0\x12\x34\xff\xff", 5)));
  const LoadedImage grey = readImageFile(folder / "grey.png");
  EXPECT_TRUE(grey.srgbEncoded);
  EXPECT_EQ(grey.image.channels(), 1);
  EXPECT_FLOAT_EQ(grey.image.at(0, 0, 0), 0x1234 / 65535.f);
  EXPECT_EQ(grey.image.at(1, 0, 0), 1);
  writeBytes(folder / "alpha.png", png(1, 1, 16, 4, std::string("\0\x80\0\x40\0", 5)));
  const LoadedImage alpha = readImageFile(folder / "alpha.png");
  EXPECT_EQ(alpha.image.channels(), 2);
  EXPECT_FLOAT_EQ(alpha.image.at(0, 0, 1), 0x4000 / 65535.f);
}

TEST(Image, HugeAndEmptySizesAreErrors) {
  const TemporaryFolder folder;
  writeBytes(folder / "huge.png", png(0xfffff, 0xfffff, 8, 2, "0"));
  EXPECT_NE(ioErrorOf([&] { readImageFile(folder / "huge.png"); }), "");
  writeBytes(folder / "none.png", png(0, 1, 8, 2, "0"));
  EXPECT_NE(ioErrorOf([&] { readImageFile(folder / "none.png"); }), "");
  for (const char* header :
       {"PF\n100000 100000\n-1\n", "PF\n0 5\n-1\n", "PF\n-3 5\n-1\n", "PF\n2147483648 1\n-1\n",
        "PF\n2 2\n0\n", "PF\n2 2\nnan\n", "PF\n2", "P6\n1 1\n255\n", "PF\na b\n-1\n", "PF", ""}) {
    writeBytes(folder / "a.pfm", header);
    EXPECT_NE(ioErrorOf([&] { readImageFile(folder / "a.pfm"); }), "") << header;
  }
}

/// stb allocates what the length of a chunk claims, and inflates whatever is deflated.
TEST(Image, PngIsRefusedMemoryThatItsSizeDoesNotNeed) {
  const TemporaryFolder folder;
  std::string bytes = png(2, 2, 8, 0, std::string(6, '\0'));
  bytes.replace(bytes.find("IDAT") - 4, 4, bigEndian(0x25000000));
  writeBytes(folder / "a.png", bytes);
  EXPECT_NE(ioErrorOf([&] { readImageFile(folder / "a.png"); }).find("memory"), std::string::npos);
}

TEST(StbMemory, IsZeroAndLimited) {
  StbMemory memory(1000);
  void* const first = StbMemory::allocate(600);
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(StbMemory::allocate(401), nullptr);
  EXPECT_TRUE(memory.wasRefused());
  std::memset(first, 0xff, 600);
  StbMemory::release(first);
  const auto* const second = static_cast<const char*>(StbMemory::allocate(600));
  ASSERT_NE(second, nullptr);
  EXPECT_EQ(std::count(second, second + 600, '\0'), 600);
}

TEST(Image, TruncatedAndGarbledFilesAreErrors) {
  const TemporaryFolder folder;
  const Image image = gradient(33, 17, 3);
  for (const std::string ending : {".png", ".jpg", ".tga", ".bmp", ".hdr", ".pfm", ".exr"}) {
    const std::string whole = folder / ("whole" + ending), part = folder / ("part" + ending);
    writeImageFile(whole, image);
    const std::string bytes = readBytes(whole);
    for (const double share : {0., 0.001, 0.01, 0.1, 0.3, 0.6, 0.9, 0.98}) {
      const auto length = static_cast<size_t>(share * static_cast<double>(bytes.size()));
      writeBytes(part, bytes.substr(0, length));
      EXPECT_NE(ioErrorOf([&] { readImageFile(part); }).find(part), std::string::npos)
          << ending << " cut to " << length << " of " << bytes.size();
    }
    // Anything may come of garbled bytes but a crash.
    for (size_t seed = 0; seed < 50; ++seed) {
      std::string garbled = bytes;
      for (size_t k = 0; k < 4; ++k)
        garbled[(seed * 7919 + k * 104729 + seed * seed * 31) %
                std::min<size_t>(garbled.size(), seed % 2 ? 400 : garbled.size())] =
            static_cast<char>(seed * 37 + k);
      writeBytes(part, garbled);
      try {
        readImageFile(part);
      } catch (const IoError&) {
      }
    }
    writeBytes(part, std::string(300, 'x'));
    EXPECT_NE(ioErrorOf([&] { readImageFile(part); }), "") << ending;
  }
}

TEST(Image, UnknownEndingsNameTheKnownOnes) {
  const TemporaryFolder folder;
  const Image image = gradient(2, 2, 3);
  EXPECT_NE(ioErrorOf([&] { readImageFile(folder / "a.gif"); }).find(".exr"), std::string::npos);
  EXPECT_NE(ioErrorOf([&] { writeImageFile(folder / "a", image); }).find(".png"),
            std::string::npos);
  EXPECT_FALSE(isWritableImagePath("a.gif"));
  EXPECT_TRUE(isWritableImagePath("dir.x/a.EXR"));
  EXPECT_FALSE(isWritableImagePath("a.exr/b"));
  EXPECT_NE(ioErrorOf([&] { readImageFile(folder / "missing.png"); }).find("missing.png"),
            std::string::npos);
  EXPECT_NE(ioErrorOf([&] { writeImageFile(folder / "a.png", Image()); }), "");
}

TEST(Image, FailedWritesDestroyNothing) {
  const TemporaryFolder folder;
  Image image(200, 200, 3);  // noise: no format makes it small
  for (size_t i = 0; i < image.data().size(); ++i)
    image.data()[i] = toUnitFloat(mixBits(static_cast<uint64_t>(i)));
  EXPECT_NE(ioErrorOf([&] { writeImageFile(folder / "no/such.exr", image); }).find("No such file"),
            std::string::npos);
  std::filesystem::create_directory(folder / "dir.png");
  EXPECT_NE(ioErrorOf([&] { writeImageFile(folder / "dir.png", image); }), "");
  EXPECT_EQ(folder.fileCount(), 1u);

  // A disk that is full after 10 000 bytes, as far as the program can tell.
  ::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  for (const std::string name : {"a.exr", "a.pfm", "a.png", "a.hdr"}) {
    writeBytes(folder / name, "older");
    rlimit small = before;
    small.rlim_cur = 10'000;
    ::setrlimit(RLIMIT_FSIZE, &small);
    const std::string error = ioErrorOf([&] { writeImageFile(folder / name, image); });
    ::setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_NE(error.find("File too large"), std::string::npos) << name << ": " << error;
    EXPECT_TRUE(readBytes(folder / name) == "older") << name;
  }
  EXPECT_EQ(folder.fileCount(), 5u);
}

TEST(ImageCache, LoadsOnce) {
  const TemporaryFolder folder;
  writeImageFile(folder / "a.pfm", gradient(2, 2, 1));
  ImageCache cache;
  const auto load = [&](const std::string& path) {
    return cache.shared<LoadedImage>(
        path, [&] { return std::make_shared<const LoadedImage>(readImageFile(path)); });
  };
  const auto first = load(folder / "a.pfm");
  std::filesystem::remove(folder / "a.pfm");
  EXPECT_EQ(load(folder / "a.pfm"), first);
  EXPECT_THROW(load(folder / "b.pfm"), IoError);
  writeImageFile(folder / "b.pfm", gradient(2, 2, 1));
  EXPECT_EQ(load(folder / "b.pfm")->image.width(), 2);
}

TEST(ImageCache, SharedIsMadeOnceAmongThreads) {
  ImageCache cache;
  std::atomic<int> made{0};
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i)
    threads.emplace_back([&] {
      for (int k = 0; k < 100; ++k) {
        const auto v = cache.shared<int>(std::to_string(k), [&] {
          ++made;
          return std::make_shared<const int>(k);
        });
        EXPECT_EQ(*v, k);
      }
    });
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(made, 100);
  // The type is part of the key.
  EXPECT_EQ(*cache.shared<double>("1", [] { return std::make_shared<const double>(0.5); }), 0.5);
}

}  // namespace
}  // namespace lampyris
