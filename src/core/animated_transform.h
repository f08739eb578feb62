// SPDX-License-Identifier: Apache-2.0
/// Maps that change with time.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include "core/transform.h"

namespace lampyris {

/// An affine map between two keys: T R S of each key (polar decomposition: Shoemake and Duff 1992,
/// "Matrix Animation and Polar Decomposition"), with T and S interpolated linearly and the rotation
/// R on the shorter arc, as in pbrt-v3. Before and after the keys it stands still.
class AnimatedTransform {
 public:
  /// Both maps affine and invertible; startTime ≤ endTime.
  AnimatedTransform(const Transform& start, float startTime, const Transform& end, float endTime);

  const Transform& start() const { return start_; }
  const Transform& end() const { return end_; }
  /// May be singular between keys of which one mirrors.
  Transform at(float time) const;
  /// A box around the mapped box at all times.
  Bounds3 bounds(const Bounds3& box) const;

 private:
  struct Key {
    explicit Key(const glm::mat4& matrix);
    glm::dvec3 translation;
    glm::dquat rotation;
    glm::dmat3 scale;
  };
  glm::dmat4 interpolated(double t) const;

  Transform start_, end_;
  float startTime_, endTime_;
  Key first_, last_;
};

}  // namespace lampyris
