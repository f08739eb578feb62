// SPDX-License-Identifier: Apache-2.0
/// A scene ready to be rendered.
#pragma once

#include <memory>
#include <vector>

#include "base/geometry.h"

namespace lampyris {

/// Owns everything that rays can meet. Immutable while rendering.
struct Scene {
  std::vector<std::unique_ptr<FloatTexture>> floatTextures;
  std::vector<std::unique_ptr<SpectrumTexture>> spectrumTextures;
  std::vector<std::unique_ptr<Material>> materials;
  std::vector<std::unique_ptr<Shape>> shapes;
  std::vector<std::unique_ptr<Light>> lights;
  std::vector<std::unique_ptr<Medium>> media;  ///< those that a shape or the camera names
  std::unique_ptr<Geometry> geometry;

  LightTable lightTable;                     ///< the lights that can be chosen
  std::vector<const Light*> infiniteLights;  ///< those that a ray can escape to
  std::vector<LightId> infiniteLightIds;     ///< their ids, kNoLight if not sampled
  Bounds3 bounds;
  const Medium* cameraMedium = nullptr;  ///< around the camera
  bool hasInterfaces = false;            ///< some surface has no material: light passes it
};

}  // namespace lampyris
