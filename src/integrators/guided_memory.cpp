// SPDX-License-Identifier: Apache-2.0
#include "integrators/guided_memory.h"

#include "core/rejections.h"

namespace lampyris {

void GuidedMemory::finish(const Rgb& radiance) {
  const auto positive = [](const Rgb& c) {  // 0/0 in channels that are lost
    return Rgb(c.r > 0 ? c.r : 0.f, c.g > 0 ? c.g : 0.f, c.b > 0 ? c.b : 0.f);
  };
  for (const Turn& t : turns) {
    GuideSample& s = samples.emplace_back(t.sample);
    s.radiance = positive((radiance - t.before) / t.throughput).luminance();
    if (std::isfinite(s.radiance)) continue;
    samples.pop_back();
    countRejection(Rejection::LearningSample);
  }
  turns.clear();
}

}  // namespace lampyris
