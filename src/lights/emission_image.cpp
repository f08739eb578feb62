// SPDX-License-Identifier: Apache-2.0
#include "lights/emission_image.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "core/error.h"
#include "core/math.h"

namespace lampyris {
namespace {

/// Where `x` lies within its period, in [0, 1]; 0 for what is not finite.
float withinPeriod(float x) {
  const float f = x - std::floor(x);
  return f >= 0 && f <= 1 ? f : 0.f;
}

struct Neighbours {
  int first, second;
  float weight;  ///< of the second
};
Neighbours neighbours(float x, int size) {
  const float at = withinPeriod(x) * static_cast<float>(size) - 0.5f;
  const float below = std::floor(at);
  int first = static_cast<int>(below);
  if (first < 0) first = size - 1;
  return {first, first + 1 == size ? 0 : first + 1, at - below};
}

}  // namespace

EmissionImage::EmissionImage(Image image)
    : image_(std::move(image)), mean_(weightedMean([](double, double) { return 1.; })) {}

std::shared_ptr<const EmissionImage> EmissionImage::load(const std::string& name, Encoding encoding,
                                                         ImageCache& images,
                                                         const BuildContext& context) {
  const std::string path = context.resolvePath ? context.resolvePath(name) : name;
  const std::string key = std::string(encoding == Encoding::Srgb ? "sRGB " : "linear ") +
                          std::filesystem::path(path).lexically_normal().string();
  return images.shared<EmissionImage>(key, [&] {
    LoadedImage loaded = readImageFile(path);
    if (encoding == Encoding::Srgb && loaded.srgbEncoded) decodeSrgb(loaded.image);
    bool faulty = false;
    for (float& v : loaded.image.data())
      if (!(v >= 0 && std::isfinite(v))) v = 0, faulty = true;
    if (faulty)
      context.diagnostics.warn(context.location,
                               "image \"" + name +
                                   "\" has values that are negative or not finite; they count as "
                                   "0");
    return std::make_shared<const EmissionImage>(std::move(loaded.image));
  });
}

Rgb EmissionImage::bilinear(const Vec2& st) const {
  const auto [x0, x1, ds] = neighbours(st.x, width());
  const auto [y0, y1, dt] = neighbours(st.y, height());
  return (1 - ds) * (1 - dt) * texel(x0, y0) + ds * (1 - dt) * texel(x1, y0) +
         (1 - ds) * dt * texel(x0, y1) + ds * dt * texel(x1, y1);
}

}  // namespace lampyris
