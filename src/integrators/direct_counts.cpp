// SPDX-License-Identifier: Apache-2.0
#include "integrators/render_loop.h"

namespace lampyris {

DirectCounts& DirectCounts::operator+=(const DirectCounts& o) {
  points += o.points;
  glossyPoints += o.glossyPoints;
  treeSamples += o.treeSamples;
  cutClusters += o.cutClusters;
  lightSamples += o.lightSamples;
  bsdfSamples += o.bsdfSamples;
  bsdfHits += o.bsdfHits;
  return *this;
}

void DirectCounts::report(Statistics& statistics) const {
  if (points == 0) return;
  const auto put = [&](const char* name, uint64_t part, uint64_t whole) {
    if (whole > 0)
      statistics.set("direct lighting", name,
                     static_cast<double>(part) / static_cast<double>(whole));
  };
  put("share of glossy points", glossyPoints, points);
  put("light tree samples a point", treeSamples, points);
  put("BRDF-oriented clusters a glossy point", cutClusters, glossyPoints);
  put("BRDF-aware samples a glossy point", lightSamples + bsdfSamples, glossyPoints);
  put("share of BSDF samples", bsdfSamples, lightSamples + bsdfSamples);
  put("share of BSDF samples that find light", bsdfHits, bsdfSamples);
}

}  // namespace lampyris
