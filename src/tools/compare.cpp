// SPDX-License-Identifier: Apache-2.0
#include "tools/compare.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tools/image_pairs.h"

namespace lampyris {

namespace {

constexpr double kTrimmedShare = 0.001;

/// Mean over the channels of 2 (a − b)² / (a² + b² + 2 ε): near (a − b)² / (b² + ε) where a is near
/// b, and 2 at most.
double boundedSquare(const std::array<double, 3>& a, const std::array<double, 3>& b,
                     double epsilon) {
  double sum = 0;
  for (size_t c = 0; c < 3; ++c)
    sum += 2 * sqr(a[c] - b[c]) / (sqr(a[c]) + sqr(b[c]) + 2 * epsilon);
  return sum / 3;
}

/// Sets the relative errors.
void compareRelatively(const Image& image, const Image& reference, double epsilon,
                       Comparison& result) {
  std::vector<double> terms;
  terms.reserve(result.pixels);
  double bounded = 0;
  forFinitePixels(image, reference, [&](int, int, const auto& a, const auto& b) {
    terms.push_back(relativeSquare(a, b, epsilon));
    bounded += boundedSquare(a, b, epsilon);
  });
  // Rounded up, so that a single firefly in a small image is left out as well.
  const auto trimmed =
      static_cast<size_t>(std::ceil(kTrimmedShare * static_cast<double>(terms.size())));
  const size_t kept = terms.size() - trimmed;
  std::nth_element(terms.begin(), terms.begin() + static_cast<std::ptrdiff_t>(kept), terms.end());
  double keptSum = 0, trimmedSum = 0;
  for (size_t i = 0; i < terms.size(); ++i) (i < kept ? keptSum : trimmedSum) += terms[i];
  result.relMse = (keptSum + trimmedSum) / static_cast<double>(terms.size());
  result.trimmedRelMse = kept > 0 ? keptSum / static_cast<double>(kept) : *result.relMse;
  result.robustRelMse = bounded / static_cast<double>(terms.size());
}

}  // namespace

Comparison compareImages(const Image& image, const Image& reference) {
  Comparison result;
  result.error = sizeError(image, reference);
  if (!result.error.empty()) return result;

  double sumA = 0, sumB = 0, squares = 0, absolutes = 0;
  size_t compared = 0;
  result.notFinite = forFinitePixels(image, reference, [&](int, int, const auto& a, const auto& b) {
    ++compared;
    for (size_t c = 0; c < 3; ++c) {
      const double d = std::abs(a[c] - b[c]);
      sumA += a[c];
      sumB += b[c];
      squares += d * d;
      absolutes += d;
      result.maxError = std::max(result.maxError, d);
    }
  });
  result.pixels = compared;
  if (compared == 0) {
    result.error = "no pixel is finite in both images";
    return result;
  }
  const double count = 3 * static_cast<double>(compared);
  result.meanImage = sumA / count;
  result.meanReference = sumB / count;
  result.mse = squares / count;
  result.rmse = std::sqrt(result.mse);
  result.mae = absolutes / count;
  const double epsilon = relativeFloor(result.meanReference);
  if (!(epsilon > 0)) return result;

  result.meanRatio = result.meanImage / result.meanReference;
  result.meanRatios = meanRatios(image, reference);
  compareRelatively(image, reference, epsilon, result);
  return result;
}

}  // namespace lampyris
