// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "core/image.h"
#include "core/image_layers.h"
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

int runConvert(const Arguments& arguments) {
  std::string from, to, layer;
  CLI::App app("Writes image A as B, in the format that B's ending says.", "lampyris convert");
  app.add_option("A", from, "Image to read")->required();
  app.add_option("B", to, "Image to write")->required();
  app.add_option("--layer", layer, "Layer of an EXR file to take instead of its image");
  if (const auto code = parseArguments(app, arguments)) return *code;
  expectWritable(to);
  writeImageFile(to, layer.empty() ? readLinearImage(from) : readExrLayer(from, layer));
  return kDone;
}

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
  if (!std::filesystem::path(path).extension().compare(".exr"))
    if (const auto layers = exrLayerNames(path); !layers.empty())
      fmt::print("layers: {}\n", fmt::join(layers, ", "));
  return kDone;
}

}  // namespace lampyris
