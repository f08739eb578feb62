// SPDX-License-Identifier: Apache-2.0
#include "tools/mean_ratio.h"

#include <cmath>
#include <limits>
#include <vector>

#include "core/math.h"

namespace lampyris {

namespace {

constexpr int kBlocks = 16;  // along an edge
constexpr size_t kLeastBlocks = 8;
constexpr double kQuantile = 1.959963984540054;

struct BlockSums {
  std::array<double, 4> image{}, reference{};
};

void add(std::array<double, 4>& sums, const Rgb& c) {
  sums[0] += static_cast<double>(c.r);
  sums[1] += static_cast<double>(c.g);
  sums[2] += static_cast<double>(c.b);
  sums[3] += static_cast<double>(c.luminance());
}

std::vector<BlockSums> blockSums(const Image& image, const Image& reference) {
  const int across = std::min(kBlocks, image.width()), down = std::min(kBlocks, image.height());
  std::vector<BlockSums> blocks(static_cast<size_t>(across) * static_cast<size_t>(down));
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const Rgb a = image.rgb(x, y), b = reference.rgb(x, y);
      if (!a.isFinite() || !b.isFinite()) continue;
      const int64_t column = int64_t{x} * across / image.width();
      const int64_t row = int64_t{y} * down / image.height();
      BlockSums& block = blocks[static_cast<size_t>(row * across + column)];
      add(block.image, a);
      add(block.reference, b);
    }
  return blocks;
}

std::optional<MeanRatio> ratioOf(const std::vector<BlockSums>& blocks, size_t channel) {
  double a = 0, b = 0;
  for (const BlockSums& block : blocks) a += block.image[channel], b += block.reference[channel];
  const double ratio = a / b;
  if (!(std::abs(b) > 0) || !std::isfinite(ratio)) return std::nullopt;
  constexpr double kUnbounded = std::numeric_limits<double>::infinity();
  if (blocks.size() < kLeastBlocks) return MeanRatio{ratio, -kUnbounded, kUnbounded};
  double squares = 0;
  for (const BlockSums& block : blocks)
    squares += sqr(block.image[channel] - ratio * block.reference[channel]);
  const auto n = static_cast<double>(blocks.size());
  const double half = kQuantile * std::sqrt(n / (n - 1) * squares) / std::abs(b);
  return MeanRatio{ratio, ratio - half, ratio + half};
}

}  // namespace

MeanRatios meanRatios(const Image& image, const Image& reference) {
  const std::vector<BlockSums> blocks = blockSums(image, reference);
  MeanRatios ratios;
  for (size_t c = 0; c < ratios.size(); ++c) ratios[c] = ratioOf(blocks, c);
  return ratios;
}

}  // namespace lampyris
