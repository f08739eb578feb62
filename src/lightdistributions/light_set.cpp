// SPDX-License-Identifier: Apache-2.0
#include "lightdistributions/light_set.h"

#include <algorithm>
#include <chrono>

#include "core/parallel.h"
#include "core/statistics.h"

namespace lampyris {
namespace {

constexpr double kLeastShare = 0.1;
/// Elements of a light that one thread asks for bounds at a time.
constexpr size_t kGrain = 8192;

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

float largestIrradiance(const Light& light) {
  float largest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 n(0);
    n[axis] = 1;
    largest = std::max(
        {largest, light.irradianceEstimate(n, false), light.irradianceEstimate(-n, false)});
  }
  return largest;
}

}  // namespace

InfiniteLights::InfiniteLights(const LightTable& lights) {
  for (size_t o = 0; o < lights.objectCount(); ++o) {
    const Light& light = lights.object(o);
    if (!light.isInfinite() || light.power(0).isBlack()) continue;
    lights_.push_back({lights.firstId(o), &light, largestIrradiance(light)});
  }
}

double InfiniteLights::Entry::irradiance(const LightReceiver& at) const {
  float e = anywhere;
  if (at.hasSurface()) {
    e = light->irradianceEstimate(at.side(), at.bothSides());
    // The geometric normal decides whether, the shading normal how much.
    if (e > 0 && !at.bothSides())
      e = std::max(e, light->irradianceEstimate(at.shadingNormal(), false));
  }
  return e > 0 && std::isfinite(e) ? static_cast<double>(e) : 0;
}

double InfiniteLights::irradiance(const LightReceiver& at) const {
  double sum = 0;
  if (at.receives())
    for (const Entry& e : lights_) sum += e.irradiance(at);
  return sum;
}

std::optional<SampledLight> InfiniteLights::sample(const LightReceiver& at, double u) const {
  const double total = irradiance(at);
  if (!(total > 0)) return std::nullopt;
  double left = u * total;
  std::optional<SampledLight> drawn;
  for (const Entry& e : lights_) {
    const double mine = e.irradiance(at);
    if (!(mine > 0)) continue;
    drawn = SampledLight{e.id, static_cast<float>(mine / total)};
    if (left < mine) break;
    left -= mine;
  }
  return drawn;
}

float InfiniteLights::pmf(const LightReceiver& at, LightId light) const {
  const double total = irradiance(at);
  if (!(total > 0)) return 0;
  for (const Entry& e : lights_)
    if (e.id == light) return static_cast<float>(e.irradiance(at) / total);
  return 0;
}

bool InfiniteLights::contains(LightId light) const {
  const auto it = std::lower_bound(lights_.begin(), lights_.end(), light,
                                   [](const Entry& e, LightId id) { return e.id < id; });
  return it != lights_.end() && it->id == light;
}

LightBVHAccel makeLightTree(const LightDistributionContext& context) {
  const Stopwatch watch;
  const LightTable& lights = context.lights;
  std::vector<LightBVHInput> inputs;
  for (size_t o = 0; o < lights.objectCount(); ++o) {
    const Light& light = lights.object(o);
    if (light.isInfinite()) continue;
    const size_t first = inputs.size(), count = light.elementCount();
    inputs.resize(first + count);
    const auto collect = [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) {
        const auto element = static_cast<uint32_t>(i);
        LightBVHInput& input = inputs[first + i];
        input.id = lights.firstId(o) + element;
        if (const auto b = light.bounds(element)) input.bounds = *b;
      }
    };
    if (count > kGrain) {
      parallelFor(count, kGrain, collect);
    } else {
      collect(0, count);
    }
  }
  LightBVHAccel tree(inputs);
  if (inputs.empty()) return tree;
  const auto report = [&](const char* name, double value) {
    context.statistics.set("light tree", name, value);
  };
  report("lights", static_cast<double>(tree.stats().lights));
  report("lights without power, dropped", static_cast<double>(tree.stats().dropped));
  report("nodes", static_cast<double>(tree.stats().nodes));
  report("depth", tree.stats().depth);
  report("bytes", static_cast<double>(tree.stats().bytes));
  report("build seconds", watch.seconds());
  return tree;
}

WideLightBVH makeWideLightTree(const LightBVHAccel& tree, const LightDistributionContext& context) {
  const Stopwatch watch;
  WideLightBVH wide(tree);
  if (wide.empty()) return wide;
  context.statistics.set("light tree", "wide nodes", static_cast<double>(wide.stats().nodes));
  context.statistics.set("light tree", "wide depth", wide.stats().depth);
  context.statistics.set("light tree", "wide bytes", static_cast<double>(wide.stats().bytes));
  context.statistics.set("light tree", "widening seconds", watch.seconds());
  return wide;
}

double infiniteShare(double infiniteIrradiance, double treeIrradiance) {
  if (!(infiniteIrradiance > 0)) return 0;
  if (!(treeIrradiance > 0)) return 1;
  return std::clamp(infiniteIrradiance / (infiniteIrradiance + treeIrradiance), kLeastShare,
                    1 - kLeastShare);
}

}  // namespace lampyris
