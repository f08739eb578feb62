// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>

#include "core/error.h"
#include "core/image.h"
#include "tools/commands.h"
#include "tools/compare.h"

namespace lampyris {

namespace {

void expectWritable(const std::string& path) {
  if (!isWritableImagePath(path))
    throw UsageError(fmt::format(
        "cannot tell the format of \"{}\": expected an ending like .exr, .png or .pfm", path));
}

}  // namespace

int runCompare(const Arguments& arguments) {
  std::string a, b, out;
  CLI::App app("How far image A is from the reference B.", "lampyris compare");
  app.add_option("A", a, "Image")->required();
  app.add_option("B", b, "Reference")->required();
  app.add_option("-o,--out", out, "Image of the error to write");
  if (const auto code = parseArguments(app, arguments)) return *code;
  if (!out.empty()) expectWritable(out);
  const Image image = readLinearImage(a), reference = readLinearImage(b);
  const Comparison comparison = compareImages(image, reference);
  if (!comparison.error.empty())
    throw IoError(fmt::format("cannot compare \"{}\" with \"{}\": {}", a, b, comparison.error));
  fmt::print("{}", formatComparison(comparison));
  if (!out.empty()) writeImageFile(out, errorImage(image, reference));
  return kDone;
}

int runConvert(const Arguments& arguments) {
  std::string from, to;
  CLI::App app("Writes image A as B, in the format that B's ending says.", "lampyris convert");
  app.add_option("A", from, "Image to read")->required();
  app.add_option("B", to, "Image to write")->required();
  if (const auto code = parseArguments(app, arguments)) return *code;
  expectWritable(to);
  writeImageFile(to, readLinearImage(from));
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
  return kDone;
}

}  // namespace lampyris
