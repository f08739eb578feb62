// SPDX-License-Identifier: Apache-2.0
#include <numeric>

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
  for (size_t i = 0; i < seconds.size(); ++i) seconds[i] += o.seconds[i];
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
  const double total = std::accumulate(seconds.begin(), seconds.end(), 0.);
  if (!(total > 0)) return;
  statistics.set("direct lighting", "share of time, light tree", seconds[0] / total);
  statistics.set("direct lighting", "share of time, BRDF-oriented", seconds[1] / total);
  statistics.set("direct lighting", "share of time, BSDF", seconds[2] / total);
}

}  // namespace lampyris
