// SPDX-License-Identifier: Apache-2.0
#include "base/shape.h"

namespace lampyris {

std::optional<ShapeHit> Shape::locate(uint32_t element, const Vec3& p, const Vec3& n) const {
  // Long enough for rounding, short enough to miss the far side.
  const float reach = 1e-3f * bounds(element).diagonal();
  Ray ray;
  ray.o = p + reach * n;
  ray.d = -2 * reach * n;
  ray.tMax = 1;
  return intersect(element, ray);
}

}  // namespace lampyris
