// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include "accelerators/light_bvh.h"
#include "base/light_distribution.h"
#include "core/statistics.h"
#include "lightdistributions/alias_table.h"

namespace lampyris {
namespace {

struct PowerParameters {
  void declare(Declaration&) {}
};

class PowerLightDistribution final : public LightDistribution {
 public:
  explicit PowerLightDistribution(const LightDistributionContext& context) {
    const LightTable& lights = context.lights;
    std::vector<double> powers;
    powers.reserve(lights.size());
    size_t dropped = 0;
    for (size_t o = 0; o < lights.objectCount(); ++o)
      for (uint32_t e = 0; e < lights.object(o).elementCount(); ++e) {
        powers.push_back(static_cast<double>(lights.object(o).power(e).luminance()));
        dropped += !(powers.back() > 0);
      }
    table_ = AliasTable(powers);
    if (dropped)
      context.statistics.set("lights", "without power, dropped", static_cast<double>(dropped));
  }

  std::optional<SampledLight> sample(const LightSampleContext& ctx, float u) const override {
    if (table_.empty() || !(ctx.reflects || ctx.transmits)) return std::nullopt;
    const LightId light = table_.sample(refineVariate(u, ctx.p));
    return SampledLight{light, table_.pmf(light)};
  }
  float pmf(const LightSampleContext& ctx, LightId light) const override {
    return ctx.reflects || ctx.transmits ? table_.pmf(light) : 0;
  }

 private:
  AliasTable table_;
};

std::unique_ptr<LightDistribution> create(const PowerParameters&,
                                          const LightDistributionContext& context) {
  return std::make_unique<PowerLightDistribution>(context);
}

}  // namespace

LightDistributionRegistry::Entry powerLightDistributionPlugin() {
  return makePlugin("power", "Lights by their emitted power.", create);
}

}  // namespace lampyris
