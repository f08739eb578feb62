// SPDX-License-Identifier: Apache-2.0
#include "base/light_distribution.h"

namespace lampyris {

LightSampleContext::LightSampleContext(const SurfaceInteraction& at, const Bsdf& b)
    : p(at.p),
      pError(at.pError),
      n(at.n),
      ns(at.shading.n),
      wo(at.wo),
      reflects(b.reflects()),
      transmits(b.transmits()),
      bsdf(&b) {}

void LightDistribution::sampleCut(const LightSampleContext& ctx, float u,
                                  SampledLights& out) const {
  if (const auto s = sample(ctx, u)) out.push_back(*s);
}

}  // namespace lampyris
