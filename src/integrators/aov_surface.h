// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/aov.h"
#include "base/bsdf.h"
#include "base/sampler.h"

namespace lampyris {

/// Tells the record of the surface where a path is shaded first: its place, the shading normal on
/// the side of the viewer, and its albedo by a BSDF sample whose numbers (a pair, then one) are
/// taken from stream.dimension() on.
inline void recordSurface(AovRecord& record, const SurfaceInteraction& at, const Bsdf& bsdf,
                          SampleStream stream) {
  const Vec2 u = stream.next2D();
  const auto s = bsdf.sample(at.wo, stream.next1D(), u);
  const bool scatters = s && s->pdf > 0;
  record.surface(at.p, faceForward(at.shading.n, at.wo),
                 scatters ? s->f * (bsdf.absCosTheta(s->wi) / s->pdf) : Rgb());
}

}  // namespace lampyris
