// SPDX-License-Identifier: Apache-2.0
#include "integrators/emitter_table.h"

#include <vector>

#include "accelerators/light_bvh.h"

namespace lampyris {

EmitterTable::EmitterTable(const LightTable& lights) {
  std::vector<double> powers;
  powers.reserve(lights.size());
  for (size_t o = 0; o < lights.objectCount(); ++o)
    for (uint32_t e = 0; e < lights.object(o).elementCount(); ++e)
      powers.push_back(static_cast<double>(lights.object(o).power(e).luminance()));
  table_ = AliasTable(powers);
}

SampledLight EmitterTable::sample(float u) const {
  const LightId light = table_.sample(refineVariate(u, Vec3(0)));
  return {light, table_.pmf(light)};
}

}  // namespace lampyris
