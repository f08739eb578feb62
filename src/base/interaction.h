// SPDX-License-Identifier: Apache-2.0
/// A point of a surface, as textures, materials and lights see it.
#pragma once

#include "base/ray.h"
#include "core/vector.h"

namespace lampyris {

struct Primitive;

/// What of an interaction is wanted beyond position, normals and uv.
enum class SurfaceDetail : uint8_t {
  Basic,  ///< p, pError, n, uv, dpdu, dpdv, shading.n, shading.dpdu
  Full,   ///< and dndu, dndv, shading.dpdv (bump maps, ray differentials)
};

/// World space throughout. Conventions of pbrt-v3: `n` is cross(dpdu, dpdv) normalised, turned
/// over where exactly one of "ReverseOrientation" and "the transform swaps handedness" holds; where
/// a mesh has vertex normals, `n` lies in the hemisphere of `shading.n`.
struct SurfaceInteraction {
  Vec3 p{0};
  Vec3 pError{0};    ///< bounds of the absolute error of p, per axis
  Vec3 n{0, 0, 1};   ///< geometric normal, unit
  Vec3 wo{0, 0, 1};  ///< unit, towards where the ray came from
  Vec2 uv{0};
  float time = 0;
  Vec3 dpdu{1, 0, 0}, dpdv{0, 1, 0};
  Vec3 dndu{0}, dndv{0};
  struct Shading {
    Vec3 n{0, 0, 1};  ///< unit
    Vec3 dpdu{1, 0, 0}, dpdv{0, 1, 0};
    Vec3 dndu{0}, dndv{0};
  } shading;
  /// Change over one pixel; zero where the ray carried no differentials.
  Vec3 dpdx{0}, dpdy{0};
  Vec2 duvdx{0}, duvdy{0};

  const Primitive* primitive = nullptr;
  uint32_t element = 0;  ///< which part of the primitive's shape, e.g. the triangle

  /// Fills dpdx … duvdy from the differentials of the ray that found this point. Leaves zeros
  /// where they are undefined.
  void computeDifferentials(const RayDifferential& d);
};

/// The origin of a ray that leaves `p` in direction `w`: outside of the error box, on the side of
/// `w`. `pError` bounds the error of p, not below the rounding of p itself; `n` is the geometric
/// normal there.
inline Vec3 offsetRayOrigin(const Vec3& p, const Vec3& pError, const Vec3& n, const Vec3& w) {
  // Twice the box: this sum rounds as well, by no more than p did, and so does the ray tracer.
  const float d = 2 * dot(absComponents(n), pError);
  return p + std::copysign(d, dot(w, n)) * n;
}

}  // namespace lampyris
