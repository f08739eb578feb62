// SPDX-License-Identifier: Apache-2.0
/// Participating media: what fills the space between surfaces.
#pragma once

#include "base/ray.h"
#include "base/texture.h"
#include "core/hash.h"
#include "core/registry.h"
#include "core/rgb.h"
#include "core/transform.h"

namespace lampyris {

/// Uniform variates in [0, 1) without limit, a function of the seed: for loops of unknown length.
/// The first two may come from a sampler, so that what is drawn with them is well distributed.
class NumberSequence {
 public:
  explicit NumberSequence(uint64_t seed) : state_(seed) {}
  NumberSequence(uint64_t seed, const Vec2& first) : state_(seed), first_(first), left_(2) {}

  float next() {
    if (left_ > 0) return --left_ == 1 ? first_.x : first_.y;
    return toUnitFloat(mixBits(state_ += 0x9e3779b97f4a7c15ULL));
  }
  Vec2 next2() {
    const float x = next();
    return {x, next()};
  }
  /// An independent sequence that starts with the numbers `first`.
  NumberSequence fork(const Vec2& first) {
    return NumberSequence(mixBits(state_ += 0x9e3779b97f4a7c15ULL) ^ 0x5851f42d4c957f2dULL, first);
  }

 private:
  uint64_t state_;
  Vec2 first_{0};
  int left_ = 0;
};

/// How a point of a medium scatters light. Directions are unit and point away from the point.
class PhaseFunction {
 public:
  virtual ~PhaseFunction() = default;
  /// Density by solid angle: integrates to 1 over `wi`.
  virtual float p(const Vec3& wo, const Vec3& wi) const = 0;
  /// A direction with exactly that density.
  virtual Vec3 sample(const Vec3& wo, const Vec2& u) const = 0;
  /// True only if p() is the same for all directions.
  virtual bool isIsotropic() const { return false; }
};

/// Where light is scattered along a ray, or that it is not.
struct MediumSample {
  bool scatters = false;  ///< at ray.at(t); else the ray reaches its end
  float t = 0;
  /// Transmittance (and where it scatters, the scattering coefficient) divided by the probability
  /// of this outcome.
  Rgb weight{1};
};

/// What following rays through media by tracking costs.
struct TrackingCounts {
  uint64_t rays = 0;   ///< through media that are tracked
  uint64_t steps = 0;  ///< tentative collisions

  TrackingCounts& operator+=(const TrackingCounts& o) {
    return rays += o.rays, steps += o.steps, *this;
  }
};

/// Immutable and thread-safe. Rays are in world space with a unit direction; tMax may be infinite.
class Medium {
 public:
  virtual ~Medium() = default;
  virtual MediumSample sample(const Ray& ray, NumberSequence& numbers,
                              TrackingCounts& counts) const = 0;
  /// Transmittance over (0, tMax), or an unbiased estimate of it.
  virtual Rgb transmittance(const Ray& ray, NumberSequence& numbers,
                            TrackingCounts& counts) const = 0;
  virtual const PhaseFunction& phase() const = 0;
};

/// The media on both sides of a surface; null: nothing. As in pbrt-v3, a surface with the same on
/// both sides leaves a ray in the medium that it is in.
struct MediumInterface {
  const Medium* inside = nullptr;
  const Medium* outside = nullptr;
  bool isTransition() const { return inside != outside; }
  /// The medium that a ray in direction `w` enters; `n` is the geometric normal.
  const Medium* towards(const Vec3& w, const Vec3& n) const {
    return dot(w, n) > 0 ? outside : inside;
  }
};

struct MediumContext : BuildContext {
  Transform mediumToWorld;
};

using MediumRegistry = Registry<Medium, MediumContext>;

}  // namespace lampyris
