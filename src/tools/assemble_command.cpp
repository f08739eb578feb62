// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "core/error.h"
#include "core/image.h"
#include "core/image_layers.h"
#include "tools/commands.h"

namespace lampyris {

namespace {

/// One image of which parts come from several files.
class Assembly {
 public:
  /// Throws IoError if the part does not fit to those before it.
  void add(const std::string& path);
  void write(const std::string& path) const;
  /// Pixels that no part has, and those that several have.
  size_t missing() const { return static_cast<size_t>(std::ranges::count(covered_, 0)); }
  size_t repeated() const { return static_cast<size_t>(std::ranges::count(covered_, 2)); }

 private:
  void open(const std::string& path, const Int2& size, int channels);

  Image whole_;
  std::string first_;             ///< the file that the others are held against
  std::vector<uint8_t> covered_;  ///< a pixel: by no part, one, several
};

void Assembly::open(const std::string& path, const Int2& size, int channels) {
  if (size.x <= 0 || size.y <= 0 || int64_t{size.x} * size.y > int64_t{1} << 32)
    throw IoError(fmt::format("\"{}\": it is part of {} x {} pixels", path, size.x, size.y));
  first_ = path;
  whole_ = Image(size.x, size.y, channels);
  covered_.assign(static_cast<size_t>(size.x) * static_cast<size_t>(size.y), 0);
}

void Assembly::add(const std::string& path) {
  if (std::filesystem::path(path).extension() != ".exr")
    throw UsageError(fmt::format(
        "\"{}\" does not tell where it belongs: only .exr files have a place in an image", path));
  const Image part = readLinearImage(path);
  const auto [at, size] = readExrPlacement(path);
  if (whole_.empty()) open(path, size, part.channels());
  if (size != Int2(whole_.width(), whole_.height()) || part.channels() != whole_.channels())
    throw IoError(
        fmt::format("\"{}\" is part of {} x {} pixels with {} channels, \"{}\" of {} x {} with {}",
                    path, size.x, size.y, part.channels(), first_, whole_.width(), whole_.height(),
                    whole_.channels()));
  for (int y = 0; y < part.height(); ++y)
    for (int x = 0; x < part.width(); ++x) {
      const int64_t toX = int64_t{at.x} + x, toY = int64_t{at.y} + y;
      if (toX < 0 || toY < 0 || toX >= size.x || toY >= size.y) continue;
      const auto pixel = static_cast<size_t>(toY * size.x + toX);
      covered_[pixel] = covered_[pixel] == 0 ? 1 : 2;
      for (int c = 0; c < part.channels(); ++c)
        whole_.at(static_cast<int>(toX), static_cast<int>(toY), c) = part.at(x, y, c);
    }
}

void Assembly::write(const std::string& path) const { writeImageFile(path, whole_); }

}  // namespace

int runAssemble(const Arguments& arguments) {
  std::vector<std::string> parts;
  std::string out;
  CLI::App app("Puts EXR images of crop windows together to the whole image.", "lampyris assemble");
  app.add_option("FILES", parts, "Parts of one image; where they overlap, the last one counts")
      ->required();
  app.add_option("-o,--out,--outfile", out, "Image to write")->required();
  if (const auto code = parseArguments(app, arguments)) return *code;
  if (!isWritableImagePath(out))
    throw UsageError(fmt::format("cannot tell the format of \"{}\"", out));
  Assembly assembly;
  for (const std::string& part : parts) assembly.add(part);
  assembly.write(out);
  if (const size_t n = assembly.missing())
    fmt::print(stderr, "{}: warning: {} pixels are in no file, and black\n", out, n);
  if (const size_t n = assembly.repeated())
    fmt::print(stderr, "{}: warning: {} pixels are in several files\n", out, n);
  return kDone;
}

int runMakeSky(const Arguments&) {
  throw UsageError(
      "makesky is not available: no Debian package has a model of the sky's light; "
      "make the image with another program and use it as an \"infinite\" light");
}

}  // namespace lampyris
