// SPDX-License-Identifier: Apache-2.0
#include "tools/pixel_probe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lampyris {

bool PixelProbe::addSample(const Int2& pixel, const Rgb& radiance, float weight) {
  samples_.push_back({radiance, weight});
  return film_.addSample(pixel, radiance, weight);
}

std::string PixelProbe::report(bool verbose) const {
  std::string text;
  double sum = 0, squares = 0, least = 0, most = 0;
  for (size_t i = 0; i < samples_.size(); ++i) {
    const auto& [c, weight] = samples_[i];
    if (verbose) text += fmt::format("sample {}: {} {} {}  weight {}\n", i, c.r, c.g, c.b, weight);
    const double y = static_cast<double>(c.luminance());
    if (!std::isfinite(y)) continue;
    sum += y;
    squares += y * y;
    least = i == 0 ? y : std::min(least, y);
    most = i == 0 ? y : std::max(most, y);
  }
  const auto n = static_cast<double>(std::max<size_t>(samples_.size(), 1));
  const double mean = sum / n;
  const double deviation = std::sqrt(std::max(0., squares / n - mean * mean));
  const Rgb value = film_.pixel(pixel_);
  return text + fmt::format(
                    "pixel {},{}: {} {} {}\n{} samples: luminance mean {:.6g}, standard "
                    "deviation {:.6g}, least {:.6g}, most {:.6g}\n",
                    pixel_.x, pixel_.y, value.r, value.g, value.b, samples_.size(), mean, deviation,
                    least, most);
}

}  // namespace lampyris
