// SPDX-License-Identifier: Apache-2.0
#include "integrators/path_vertex.h"

#include "integrators/transmittance.h"

namespace lampyris {

std::optional<BsdfSample> PathVertex::sample(float uc, const Vec2& u) const {
  if (isSurface()) return bsdf.sample(at.wo, uc, u);
  const Vec3 wi = medium->phase().sample(at.wo, u);
  const float p = medium->phase().p(at.wo, wi);
  BsdfSample s;
  s.wi = wi;
  s.f = Rgb(p);
  s.pdf = p;
  return s;
}

float PathVertex::importanceCosine(const Vec3& in, const Vec3& out) const {
  if (!isSurface()) return 1;
  return safeDivide(bsdf.absCosTheta(in) * absDot(out, at.n), absDot(in, at.n));
}

LightSampleContext PathVertex::context() const {
  if (isSurface()) return {at, bsdf};
  LightSampleContext c;
  c.p = at.p;
  c.wo = at.wo;
  return c;
}

const Medium* PathVertex::mediumTowards(const Vec3& w) const {
  return isSurface() ? mediumBeyond(*at.primitive, medium, w, at.n) : medium;
}

}  // namespace lampyris
