// SPDX-License-Identifier: Apache-2.0
#include "lights/picture_means.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include "core/math.h"
#include "core/parallel.h"
#include "core/sampling.h"

namespace lampyris {
namespace {

using Corners = std::array<glm::dvec2, 3>;

constexpr unsigned kMaxSide = 4096;
/// Cells that the box of a triangle may hold, and span along an axis.
constexpr double kMaxCells = 1024, kMaxSpan = 256;
/// Triangles that span so few texels are looked up at points, too; cells, which miss nothing, keep
/// a share.
constexpr double kFewTexels = 3, kCellsShare = 0.01;
/// Lines at which a row of cells is cut to measure coverage.
constexpr int kLines = 4;
/// Beyond this sums could overflow.
constexpr float kLargest = 1e34f;
/// Weight of a cell that the triangle touches, beyond its coverage: nothing that emits is lost.
constexpr double kTouch = 1e-3;

size_t cellIndex(int x, int y, int width) {
  return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
}

/// ∫ of the hat max(0, 1 − |x|) from −∞.
double hatIntegral(double x) {
  if (x <= -1) return 0;
  if (x >= 1) return 1;
  return x < 0 ? (x + 1) * (x + 1) / 2 : 1 - (1 - x) * (1 - x) / 2;
}

/// Averages a line of texels, interpolated linearly and repeating, over equal cells.
void averageLine(const float* texels, size_t stride, int count, float* cells, size_t cellStride,
                 int cellCount) {
  const double width = static_cast<double>(count) / cellCount;
  for (int i = 0; i < cellCount; ++i) {
    const double begin = i * width, end = (i + 1) * width;
    double sum = 0;
    const int last = static_cast<int>(std::floor(end + 0.5));
    for (int k = static_cast<int>(std::floor(begin - 0.5)); k <= last; ++k) {
      const double centre = k + 0.5;
      const double weight = hatIntegral(end - centre) - hatIntegral(begin - centre);
      const int wrapped = ((k % count) + count) % count;
      sum += weight * static_cast<double>(texels[static_cast<size_t>(wrapped) * stride]);
    }
    cells[static_cast<size_t>(i) * cellStride] = static_cast<float>(sum / width);
  }
}

struct Interval {
  double lo = 1e300, hi = -1e300;
  void add(double x) { lo = std::min(lo, x), hi = std::max(hi, x); }
};

/// The extent along x of what of the triangle lies between y0 and y1.
Interval extentBetween(const Corners& c, double y0, double y1) {
  Interval all;
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec2 a = c[i], b = c[(i + 1) % 3];
    if (a.y >= y0 && a.y <= y1) all.add(a.x);
    for (const double y : {y0, y1})
      if ((a.y < y) != (b.y < y))
        all.add(std::lerp(a.x, b.x, std::clamp((y - a.y) / (b.y - a.y), 0., 1.)));
  }
  return all;
}

}  // namespace

float PictureMeans::luminanceAt(const Rgb& texel) const {
  return std::min((texel * scale_).luminance(), kLargest);
}

PictureMeans::Level PictureMeans::finest() const {
  const int w = picture_->width(), h = picture_->height();
  const auto side = [](int n) {
    return static_cast<int>(std::min(2 * std::bit_ceil(static_cast<unsigned>(n)), kMaxSide));
  };
  Level level{side(w), side(h), {}};
  const auto stride = static_cast<size_t>(level.width);
  std::vector<float> wide(cellIndex(0, h, level.width));
  parallelFor(static_cast<size_t>(h), 16, [&](size_t begin, size_t end) {
    std::vector<float> line(static_cast<size_t>(w));
    for (size_t y = begin; y < end; ++y) {
      for (int x = 0; x < w; ++x)
        line[static_cast<size_t>(x)] = luminanceAt(picture_->texel(x, static_cast<int>(y)));
      averageLine(line.data(), 1, w, &wide[y * stride], 1, level.width);
    }
  });
  level.cells.resize(cellIndex(0, level.height, level.width));
  parallelFor(stride, 16, [&](size_t begin, size_t end) {
    for (size_t x = begin; x < end; ++x)
      averageLine(&wide[x], stride, h, &level.cells[x], stride, level.height);
  });
  return level;
}

PictureMeans::Level PictureMeans::halved(const Level& below) {
  const int dx = below.width > 1 ? 1 : 0, dy = below.height > 1 ? 1 : 0;
  Level level{below.width >> dx, below.height >> dy, {}};
  level.cells.reserve(cellIndex(0, level.height, level.width));
  for (int y = 0; y < level.height; ++y)
    for (int x = 0; x < level.width; ++x) {
      const auto at = [&](int i, int j) {
        return below.cells[cellIndex((x << dx) + i, (y << dy) + j, below.width)];
      };
      level.cells.push_back(0.25f * (at(0, 0) + at(dx, 0) + at(0, dy) + at(dx, dy)));
    }
  return level;
}

PictureMeans::PictureMeans(std::shared_ptr<const EmissionImage> picture, const Rgb& scale)
    : picture_(std::move(picture)), scale_(scale) {
  levels_.push_back(finest());
  while (levels_.back().cells.size() > 1) levels_.push_back(halved(levels_.back()));
}

float PictureMeans::over(const std::array<Vec2, 3>& uv) const {
  Corners corners;
  for (size_t i = 0; i < 3; ++i) corners[i] = {uv[i].x, 1 - static_cast<double>(uv[i].y)};
  const glm::dvec2 lo = glm::min(corners[0], glm::min(corners[1], corners[2]));
  const glm::dvec2 hi = glm::max(corners[0], glm::max(corners[1], corners[2]));
  // What interpolation in float may be off by.
  const glm::dvec2 slack = 4e-7 * (1. + glm::max(absComponents(lo), absComponents(hi)));
  const glm::dvec2 extent = hi - lo + 2. * slack;
  for (glm::dvec2& c : corners) c -= glm::floor(lo);
  for (const Level& level : levels_) {
    // Cells are touched along with parts of them.
    const double x = extent.x * level.width + 1, y = extent.y * level.height + 1;
    if (!(x * y <= kMaxCells && x <= kMaxSpan && y <= kMaxSpan)) continue;
    const double mean = level.over(corners, slack);
    const double texels = std::max(extent.x * picture_->width(), extent.y * picture_->height());
    return static_cast<float>(
        texels <= kFewTexels ? std::lerp(overPoints(corners, texels), mean, kCellsShare) : mean);
  }
  return levels_.back().cells[0];  // many repetitions, or numbers that are not finite
}

double PictureMeans::overPoints(const Corners& corners, double texels) const {
  const int side = 2 + static_cast<int>(2 * texels);
  double sum = 0;
  for (int i = 0; i < side * side; ++i) {
    const Vec2 u = (Vec2(i % side, i / side) + 0.5f) / static_cast<float>(side);
    const Vec2 b = sampleUniformTriangle(u);
    const Vec2 at =
        b.x * Vec2(corners[0]) + b.y * Vec2(corners[1]) + (1 - b.x - b.y) * Vec2(corners[2]);
    sum += static_cast<double>(luminanceAt(picture_->bilinear(at)));
  }
  return sum / (side * side);
}

double PictureMeans::Level::over(Corners corners, glm::dvec2 slack) const {
  const glm::dvec2 size(width, height);
  for (glm::dvec2& c : corners) c *= size;
  slack *= size;
  const double top = std::min({corners[0].y, corners[1].y, corners[2].y}) - slack.y;
  const double bottom = std::max({corners[0].y, corners[1].y, corners[2].y}) + slack.y;
  double sum = 0, weights = 0;
  for (int j = static_cast<int>(std::floor(top)); j <= static_cast<int>(std::floor(bottom)); ++j) {
    const Interval touched = extentBetween(corners, j - slack.y, j + 1 + slack.y);
    std::array<Interval, kLines> lines;
    for (size_t k = 0; k < kLines; ++k) {
      const double y = j + (static_cast<double>(k) + 0.5) / kLines;
      lines[k] = extentBetween(corners, y, y);
    }
    const int last = static_cast<int>(std::floor(touched.hi + slack.x));
    for (int i = static_cast<int>(std::floor(touched.lo - slack.x)); i <= last; ++i) {
      double weight = kTouch;
      for (const Interval& line : lines)
        weight += std::max(0., std::min(line.hi, i + 1.) - std::max<double>(line.lo, i)) / kLines;
      const float cell = cells[cellIndex(i & (width - 1), j & (height - 1), width)];
      sum += weight * static_cast<double>(cell);
      weights += weight;
    }
  }
  return sum / weights;
}

}  // namespace lampyris
