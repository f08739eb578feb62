// SPDX-License-Identifier: Apache-2.0
#include "base/sampled_surface.h"

#include <cmath>

#include "core/math.h"
#include "core/rejections.h"

namespace lampyris {

std::optional<ShapeSample> SampledSurface::sampleSolidAngle(uint32_t element, const Vec3& from,
                                                            const Vec2& u) const {
  auto s = sampleArea(element, u);
  if (!s) return s;
  s->pdf = pdfSolidAngle(element, from, s->p, s->n);
  if (s->pdf > 0 && std::isfinite(s->pdf)) return s;
  // Seen edge on there is nothing to draw.
  if (dot(s->n, s->p - from) != 0) countRejection(Rejection::LightDensity);
  return std::nullopt;
}

float SampledSurface::pdfArea(uint32_t element, const Vec3& n) const {
  (void)n;
  return safeDivide(1, area(element));
}

float SampledSurface::pdfSolidAngle(uint32_t element, const Vec3& from, const Vec3& p,
                                    const Vec3& n) const {
  const Vec3 d = p - from;
  const float distance2 = lengthSquared(d);
  const float cosine = absDot(n, d) / std::sqrt(distance2);
  return safeDivide(distance2 * pdfArea(element, n), cosine);
}

}  // namespace lampyris
