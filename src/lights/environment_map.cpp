// SPDX-License-Identifier: Apache-2.0
#include "lights/environment_map.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/frame.h"
#include "core/parallel.h"

namespace lampyris {
namespace {

/// More fine cells than this are taken together, two by two each way.
constexpr size_t kMaxCells = size_t{1} << 25;
/// Least share of a cell in its row, and of a row in the table: below it the difference of two
/// float sums could round to no probability at all.
constexpr float kLeastShare = 0x1p-22f;

Vec2 toSt(const Vec3& w) {
  // atan2 stays precise near the poles, where acos(z) has no digits left.
  const float theta = std::atan2(std::hypot(w.x, w.y), w.z);
  return {sphericalPhi(w) / (2 * kPi), theta * kInvPi};
}

std::array<double, 9> sphericalHarmonics(double x, double y, double z) {
  return {0.282095,
          0.488603 * y,
          0.488603 * z,
          0.488603 * x,
          1.092548 * x * y,
          1.092548 * y * z,
          0.315392 * (3 * z * z - 1),
          1.092548 * x * z,
          0.546274 * (x * x - y * y)};
}

/// Raises positive values to `least`.
void raise(std::span<float> values, float least) {
  for (float& v : values)
    if (v > 0) v = std::max(v, least);
}

/// Raises small values so that no probability of the table vanishes.
void keepAllShares(std::vector<float>& values, size_t width) {
  const size_t height = values.size() / width;
  std::vector<double> sums(height);
  for (size_t y = 0; y < height; ++y) {
    const std::span<float> row(&values[y * width], width);
    sums[y] = std::accumulate(row.begin(), row.end(), 0.);
    raise(row, static_cast<float>(sums[y]) * kLeastShare);
  }
  const double least = std::accumulate(sums.begin(), sums.end(), 0.) * kLeastShare;
  for (size_t y = 0; y < height; ++y) {
    if (!(sums[y] > 0) || sums[y] >= least) continue;
    const auto factor = static_cast<float>(least / sums[y]);
    for (size_t x = 0; x < width; ++x) values[y * width + x] *= factor;
  }
}

/// Sums over one row of cells of equal solid angle.
struct RowSums {
  double r = 0, g = 0, b = 0;
  std::array<double, 9> harmonics{};

  void add(const Rgb& c, double weight, const std::array<double, 9>& sh) {
    r += weight * static_cast<double>(c.r);
    g += weight * static_cast<double>(c.g);
    b += weight * static_cast<double>(c.b);
    const double y = weight * static_cast<double>(c.luminance());
    for (size_t i = 0; i < 9; ++i) harmonics[i] += y * sh[i];
  }
};

}  // namespace

EnvironmentMap::EnvironmentMap(std::shared_ptr<const EmissionImage> image, const Rgb& scale)
    : image_(std::move(image)), scale_(scale) {
  buildTables();
}

void EnvironmentMap::buildTables() {
  // Cells half as wide as texels lie in one bilinear patch each, so the value at the centre is
  // positive wherever any of the cell is.
  const auto fineWidth = 2 * static_cast<size_t>(image_->width());
  const auto fineHeight = 2 * static_cast<size_t>(image_->height());
  const size_t block = fineWidth * fineHeight > kMaxCells ? 2 : 1;
  const size_t width = fineWidth / block, height = fineHeight / block;
  std::vector<float> values(width * height, 0.f);
  std::vector<RowSums> sums(height);
  const double cellAngles = 2 * sqr(3.14159265358979323846) /
                            (static_cast<double>(fineWidth) * static_cast<double>(fineHeight));
  parallelFor(height, 8, [&](size_t begin, size_t end) {
    for (size_t fy = begin * block; fy < end * block; ++fy) {
      const float t = (static_cast<float>(fy) + 0.5f) / static_cast<float>(fineHeight);
      const float sine = std::sin(kPi * t), cosine = std::cos(kPi * t);
      const double weight = cellAngles * static_cast<double>(sine);
      for (size_t fx = 0; fx < fineWidth; ++fx) {
        const float s = (static_cast<float>(fx) + 0.5f) / static_cast<float>(fineWidth);
        const Rgb c = image_->bilinear({s, t});
        values[fy / block * width + fx / block] += (c * scale_).luminance() * sine;
        const Vec3 d = sphericalDirection(sine, cosine, 2 * kPi * s);
        sums[fy / block].add(c, weight, sphericalHarmonics(d.x, d.y, d.z));
      }
    }
  });
  RowSums total;
  for (const RowSums& row : sums) {
    total.r += row.r, total.g += row.g, total.b += row.b;
    for (size_t i = 0; i < 9; ++i) total.harmonics[i] += row.harmonics[i];
  }
  const double whole = 4 * 3.14159265358979323846;
  mean_ = scale_ * Rgb(static_cast<float>(total.r / whole), static_cast<float>(total.g / whole),
                       static_cast<float>(total.b / whole));
  const auto unscaled = total.harmonics[0];
  const double factor =
      unscaled > 0 ? static_cast<double>(mean_.luminance()) * whole * 0.282095 / unscaled : 0;
  for (size_t i = 0; i < 9; ++i) harmonics_[i] = total.harmonics[i] * factor;
  keepAllShares(values, width);
  distribution_ = Distribution2D(values, static_cast<int>(width), static_cast<int>(height));
}

Rgb EnvironmentMap::radiance(const Vec3& w) const { return scale_ * image_->bilinear(toSt(w)); }

Vec3 EnvironmentMap::sample(const Vec2& u) const {
  const Vec2 st = distribution_.sample(u).p;
  const float theta = kPi * st.y;
  return sphericalDirection(std::sin(theta), std::cos(theta), 2 * kPi * st.x);
}

float EnvironmentMap::pdf(const Vec3& w) const {
  const float sine = std::hypot(w.x, w.y);
  return safeDivide(distribution_.pdf(toSt(w)), 2 * kPi * kPi * sine);
}

float EnvironmentMap::irradiance(const Vec3& n, bool bothSides) const {
  const auto sh = sphericalHarmonics(n.x, n.y, n.z);
  // Factors of the clamped cosine per degree: π, 2π/3, π/4.
  const double even =
      3.141593 * harmonics_[0] * sh[0] +
      0.785398 * (harmonics_[4] * sh[4] + harmonics_[5] * sh[5] + harmonics_[6] * sh[6] +
                  harmonics_[7] * sh[7] + harmonics_[8] * sh[8]);
  const double odd =
      2.094395 * (harmonics_[1] * sh[1] + harmonics_[2] * sh[2] + harmonics_[3] * sh[3]);
  const double estimate = bothSides ? 2 * even : even + odd;
  const double least = 0.02 * 3.141593 * static_cast<double>(mean_.luminance());
  return static_cast<float>(std::max(estimate, least));
}

}  // namespace lampyris
