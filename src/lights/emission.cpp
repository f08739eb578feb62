// SPDX-License-Identifier: Apache-2.0
#include "lights/emission.h"

#include <cmath>

#include "core/error.h"

namespace lampyris {

Rgb emittedColor(const Rgb& color, const Rgb& scale, const BuildContext& context) {
  const Rgb product = color * scale;
  if (!product.isFinite())
    throw SceneError(context.location,
                     "the light's colour times its \"scale\" is not a finite number; use smaller "
                     "values");
  const Rgb clamped = clampPositive(product);
  if (!(clamped == product))
    context.diagnostics.warn(context.location,
                             "the light's colour has negative components, which count as 0");
  return clamped;
}

bool keepsAngles(const Transform& t) {
  const Vec3 x = t.vector({1, 0, 0}), y = t.vector({0, 1, 0}), z = t.vector({0, 0, 1});
  const float scale = lengthSquared(x), tolerance = 1e-4f * scale;
  return std::abs(lengthSquared(y) - scale) < tolerance &&
         std::abs(lengthSquared(z) - scale) < tolerance && absDot(x, y) < tolerance &&
         absDot(y, z) < tolerance && absDot(z, x) < tolerance;
}

}  // namespace lampyris
