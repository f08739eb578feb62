// SPDX-License-Identifier: Apache-2.0
/// The scene's surfaces for rays.
#pragma once

#include "base/light.h"
#include "base/material.h"
#include "base/medium.h"
#include "base/shape.h"
#include "core/animated_transform.h"

namespace lampyris {

/// A shape in the scene.
struct Primitive {
  const Shape* shape = nullptr;
  const Material* material = nullptr;         ///< null: an interface that rays pass
  const Light* light = nullptr;               ///< if it emits
  LightId firstLight = kNoLight;              ///< kNoLight: emits, but is not sampled
  bool isOneLight = false;                    ///< whatever the element; else firstLight + element
  const FloatTexture* alpha = nullptr;        ///< rays pass where it is 0
  const FloatTexture* shadowAlpha = nullptr;  ///< the same for occlusion tests
  MediumInterface media;
  LightId lightId(uint32_t element) const {
    return firstLight == kNoLight || isOneLight ? firstLight : firstLight + element;
  }
};

/// Where a ray meets the scene first.
struct Hit {
  ShapeHit shape;
  uint32_t primitive = 0;  ///< index in the scene's primitives
  uint32_t element = 0;
  uint32_t instance = kNoInstance;
  static constexpr uint32_t kNoInstance = ~uint32_t{0};
};

class Geometry {
 public:
  virtual ~Geometry() = default;
  /// The nearest hit with 0 < t < ray.tMax.
  virtual std::optional<Hit> intersect(const Ray& ray) const = 0;
  /// Whether anything lies at 0 < t < ray.tMax.
  virtual bool occluded(const Ray& ray) const = 0;
  /// The surface at a hit of `ray`, in world space, `wo` set.
  virtual SurfaceInteraction surface(const Ray& ray, const Hit& hit,
                                     SurfaceDetail detail) const = 0;
  virtual const Primitive& primitive(const Hit& hit) const = 0;
  virtual Bounds3 bounds() const = 0;
};

/// Shapes that are placed several times.
struct ObjectDefinition {
  std::vector<Primitive> primitives;
};
struct ObjectInstance {
  uint32_t object = 0;        ///< index in the definitions
  Transform instanceToWorld;  ///< to be applied to the definition's coordinates
  /// Not empty: it moves, and these count instead, the last one applied first.
  std::vector<AnimatedTransform> motion{};

  Transform toWorld(float time) const {
    if (motion.empty()) return instanceToWorld;
    Transform t = motion[0].at(time);
    for (size_t i = 1; i < motion.size(); ++i) t = t * motion[i].at(time);
    return t;
  }
};
/// What a Geometry is built of.
struct GeometryDescription {
  std::vector<Primitive> primitives;
  std::vector<ObjectDefinition> objects;
  std::vector<ObjectInstance> instances;
};

}  // namespace lampyris
