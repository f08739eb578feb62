// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "core/image.h"
#include "core/image_layers.h"
#include "core/math.h"
#include "tools/commands.h"
#include "tools/compare.h"
#include "tools/error_image.h"

namespace lampyris {

namespace {

constexpr const char* kCompareFooter = R"(
With a an image's value and b the reference's, over all pixels and the channels of linear RGB,
and e = (0.01 mean of b)^2:
  relMSE            mean of (a - b)^2 / (b^2 + e)
  relMSE, robust    mean of 2 (a - b)^2 / (a^2 + b^2 + 2 e): no pixel counts more than 2
  relMSE, trimmed   relMSE without the 0.1 % of the pixels with the largest terms
  mean ratio        mean of a / mean of b; by channel with its 95 % confidence interval, from
                    the spread over 16 x 16 blocks
The error image shows the relative error from 0.001 (black) to 1 and more (white).)";

void expectWritable(const std::string& path) {
  if (!isWritableImagePath(path))
    throw UsageError(fmt::format(
        "cannot tell the format of \"{}\": expected an ending like .exr, .png or .pfm", path));
}

}  // namespace

int runCompare(const Arguments& arguments) {
  std::string a, b, out;
  bool json = false;
  CLI::App app("How far image A is from the reference B.", "lampyris compare");
  app.add_option("A", a, "Image")->required();
  app.add_option("B", b, "Reference")->required();
  app.footer(kCompareFooter);
  app.add_option("-o,--out,--error-image", out, "Image of the error to write, in false colour");
  app.add_flag("--json", json, "Print JSON instead of a table");
  if (const auto code = parseArguments(app, arguments)) return *code;
  if (!out.empty()) expectWritable(out);
  const Image image = readLinearImage(a), reference = readLinearImage(b);
  const Comparison comparison = compareImages(image, reference);
  if (!comparison.error.empty())
    throw IoError(fmt::format("cannot compare \"{}\" with \"{}\": {}", a, b, comparison.error));
  fmt::print("{}", json ? comparisonJson(comparison) : formatComparison(comparison));
  if (!out.empty()) writeImageFile(out, errorImage(image, reference));
  return kDone;
}

namespace {

struct Conversion {
  float scale = 1, maxLuminance = 1;
  bool flipY = false, toneMap = false;
};

/// Reinhard et al. 2002, "Photographic Tone Reproduction for Digital Images", eq. 4: the luminance
/// `white` and all above become 1.
float toneMapped(float luminance, float white) {
  return luminance * (1 + luminance / sqr(white)) / (1 + luminance);
}

/// All channels but alpha, in this order: flipped, scaled, tone-mapped.
Image converted(const Image& image, const Conversion& how) {
  Image out = image;
  const int colours = image.channels() > 2 ? 3 : 1;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const int from = how.flipY ? image.height() - 1 - y : y;
      const float luminance = how.scale * image.rgb(x, from).luminance();
      const bool maps = how.toneMap && luminance > 0;
      const float factor =
          maps ? how.scale * toneMapped(luminance, how.maxLuminance) / luminance : how.scale;
      for (int c = 0; c < image.channels(); ++c)
        out.at(x, y, c) = image.at(x, from, c) * (c < colours ? factor : 1);
    }
  return out;
}

}  // namespace

int runConvert(const Arguments& arguments) {
  std::string from, to, layer;
  Conversion how;
  CLI::App app("Writes image A as B, in the format that B's ending says.", "lampyris convert");
  app.add_option("A", from, "Image to read")->required();
  app.add_option("B", to, "Image to write")->required();
  app.add_option("--layer", layer, "Layer of an EXR file to take instead of its image");
  app.add_option("--scale", how.scale, "Factor on all values but alpha")
      ->check(CLI::NonNegativeNumber);
  app.add_flag("--flipy", how.flipY, "Turn the image upside down");
  app.add_flag("--tonemap", how.toneMap, "Compress bright values (Reinhard et al. 2002)");
  app.add_option("--maxluminance", how.maxLuminance, "Luminance that --tonemap turns into white")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  if (const auto code = parseArguments(app, arguments)) return *code;
  expectWritable(to);
  const Image image = layer.empty() ? readLinearImage(from) : readExrLayer(from, layer);
  writeImageFile(to, converted(image, how));
  return kDone;
}

namespace {

void printExrParts(const std::string& path, const Image& image) {
  const ImagePlacement place = readExrPlacement(path);
  if (place.offset != Int2(0) || place.fullSize != Int2(image.width(), image.height()))
    fmt::print("part of {} x {}, at {},{}\n", place.fullSize.x, place.fullSize.y, place.offset.x,
               place.offset.y);
  if (const auto layers = exrLayerNames(path); !layers.empty())
    fmt::print("layers: {}\n", fmt::join(layers, ", "));
}

}  // namespace

int runInfo(const Arguments& arguments) {
  std::string path;
  CLI::App app("Size, channels and mean of an image.", "lampyris info");
  app.add_option("FILE", path, "Image")->required();
  if (const auto code = parseArguments(app, arguments)) return *code;
  const Image image = readLinearImage(path);
  const auto channels = static_cast<size_t>(image.channels());
  std::vector<double> sum(channels);
  size_t bad = 0;
  for (size_t i = 0; i < image.data().size(); ++i) {
    const float v = image.data()[i];
    if (std::isfinite(v))
      sum[i % channels] += static_cast<double>(v);
    else
      ++bad;
  }
  for (double& s : sum) s /= static_cast<double>(image.width()) * image.height();
  fmt::print("{}: {} x {}, {} channel{}, mean {:.6g}", path, image.width(), image.height(),
             channels, channels == 1 ? "" : "s", fmt::join(sum, " "));
  fmt::print("{}\n", bad > 0 ? fmt::format(", {} values not finite", bad) : "");
  if (std::filesystem::path(path).extension() == ".exr") printExrParts(path, image);
  return kDone;
}

}  // namespace lampyris
