// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <vector>

#include "accelerators/light_bvh.h"
#include "base/light_distribution.h"
#include "core/statistics.h"

namespace lampyris {
namespace {

struct UniformParameters {
  void declare(Declaration&) {}
};

/// All lights that emit, alike.
class UniformLightDistribution final : public LightDistribution {
 public:
  explicit UniformLightDistribution(const LightDistributionContext& context) {
    const LightTable& lights = context.lights;
    for (size_t o = 0; o < lights.objectCount(); ++o)
      for (uint32_t e = 0; e < lights.object(o).elementCount(); ++e) {
        const Rgb power = lights.object(o).power(e);
        if (!power.isBlack() && power.isFinite()) ids_.push_back(lights.firstId(o) + e);
      }
    const size_t dropped = lights.size() - ids_.size();
    if (dropped)
      context.statistics.set("lights", "without power, dropped", static_cast<double>(dropped));
  }

  std::optional<SampledLight> sample(const LightSampleContext& ctx, float u) const override {
    if (ids_.empty() || !(ctx.reflects || ctx.transmits)) return std::nullopt;
    if (ids_.size() == 1) return SampledLight{ids_[0], 1};
    const double at = refineVariate(u, ctx.p) * static_cast<double>(ids_.size());
    return SampledLight{ids_[std::min(static_cast<size_t>(at), ids_.size() - 1)], each()};
  }
  float pmf(const LightSampleContext& ctx, LightId light) const override {
    if (!(ctx.reflects || ctx.transmits)) return 0;
    return std::binary_search(ids_.begin(), ids_.end(), light) ? each() : 0;
  }

 private:
  float each() const { return static_cast<float>(1 / static_cast<double>(ids_.size())); }
  std::vector<LightId> ids_;  ///< ascending
};

std::unique_ptr<LightDistribution> create(const UniformParameters&,
                                          const LightDistributionContext& context) {
  return std::make_unique<UniformLightDistribution>(context);
}

}  // namespace

LightDistributionRegistry::Entry uniformLightDistributionPlugin() {
  return makePlugin("uniform", "Every light alike.", create);
}

}  // namespace lampyris
