// SPDX-License-Identifier: Apache-2.0
#include "tools/cache_picture.h"

#include <algorithm>
#include <cmath>

namespace lampyris {

namespace {

constexpr Vec2 kLensCentre(0.5f);

/// Length of the line of an exponent of 1, in distances from the camera; each doubling adds as
/// much.
constexpr float kLineLength = 0.006f;

bool seen(const Scene& scene, const Vec3& lens, const Vec3& p) {
  constexpr float kNearly = 0.99f;
  Ray ray{lens, normalize(p - lens), kInfinity, 0};
  ray.tMax = kNearly * length(p - lens);
  return !scene.geometry->intersect(ray);
}

/// Black to blue, green and red for 0 to 1.
Rgb heat(float t) {
  const auto part = [t](float middle) { return std::max(0.f, 1 - 2 * std::abs(t - middle)); };
  return {part(1), part(0.5f), part(0)};
}

void dot(Image& image, const Vec2& at, const Rgb& colour) {
  const int x = static_cast<int>(std::floor(at.x)), y = static_cast<int>(std::floor(at.y));
  if (x >= 0 && y >= 0 && x < image.width() && y < image.height()) image.setRgb(x, y, colour);
}

void line(Image& image, const Vec2& from, const Vec2& to, const Rgb& colour) {
  // Nothing that a projection throws far away is followed for long.
  const float most = static_cast<float>(image.width() + image.height());
  const float steps = std::min(most, std::ceil(glm::length(to - from)));
  for (float k = 0; k < steps; ++k) dot(image, from + (to - from) * (k / steps), colour);
}

}  // namespace

size_t drawDirections(Image& image, const Int2& first, const Scene& scene, const Camera& camera,
                      std::span<const LearnedDirection> directions) {
  float least = kInfinity, most = 0;
  for (const LearnedDirection& d : directions)
    if (d.radiance > 0) least = std::min(least, d.radiance), most = std::max(most, d.radiance);
  const float range = std::max(std::log(most / least), 1e-3f);
  size_t drawn = 0;
  for (const LearnedDirection& d : directions) {
    const auto at = camera.project(d.p, kLensCentre, 0);
    if (!at || !(d.radiance > 0) || !seen(scene, at->lens, d.p)) continue;
    const Vec2 point = at->film - Vec2(first);
    if (!(point.x >= 0 && point.y >= 0 && point.x < static_cast<float>(image.width()) &&
          point.y < static_cast<float>(image.height())))
      continue;
    const Rgb colour = heat(std::clamp(std::log(d.radiance / least) / range, 0.f, 1.f));
    const float reach = kLineLength * length(d.p - at->lens) * (1 + std::log2(d.exponent));
    if (const auto end = camera.project(d.p + reach * d.direction, kLensCentre, 0))
      line(image, point, end->film - Vec2(first), colour * 0.6f);
    dot(image, point, colour);
    ++drawn;
  }
  return drawn;
}

}  // namespace lampyris
