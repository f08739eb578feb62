// SPDX-License-Identifier: Apache-2.0
/// Whether two images have the same mean, and how sure that is.
#pragma once

#include <array>
#include <optional>

#include "core/image.h"

namespace lampyris {

/// The ratio of two means, with the bounds of its 95 % confidence interval.
struct MeanRatio {
  double ratio = 0, low = 0, high = 0;
};

/// Red, green, blue and luminance; none where the reference's mean is 0.
using MeanRatios = std::array<std::optional<MeanRatio>, 4>;

/// The images are cut into up to 16 × 16 blocks of about equal size. With Aᵢ, Bᵢ the sums of the n
/// blocks, the ratio R is ΣA / ΣB, its standard error √(n/(n−1) Σ(Aᵢ − R Bᵢ)²) / |ΣB| (Cochran
/// 1977, ch. 6), and the interval ±1.96 of it. Blocks, not pixels, because filters and denoisers
/// make the errors of neighbouring pixels alike. The interval is infinite with fewer than 8 blocks.
/// Pixels that are not finite in both images are left out. Sizes must agree.
MeanRatios meanRatios(const Image& image, const Image& reference);

}  // namespace lampyris
