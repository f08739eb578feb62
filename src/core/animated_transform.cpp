// SPDX-License-Identifier: Apache-2.0
#include "core/animated_transform.h"

#include <algorithm>
#include <cmath>

namespace lampyris {

namespace {

/// The rotation nearest to a regular matrix, by averaging it with its inverse transpose.
glm::dmat3 nearestRotation(const glm::dmat3& m) {
  glm::dmat3 r = m;
  for (int i = 0; i < 100; ++i) {
    const glm::dmat3 next = 0.5 * (r + glm::transpose(glm::inverse(r)));
    double change = 0;
    for (int c = 0; c < 3; ++c) change = std::max(change, glm::length(next[c] - r[c]));
    r = next;
    if (!(change > 1e-14)) break;
  }
  return r;
}

}  // namespace

AnimatedTransform::Key::Key(const glm::mat4& matrix)
    : translation(matrix[3]), rotation(1, 0, 0, 0), scale(glm::mat3(matrix)) {
  // The size does not matter to the rotation; without it the iteration ends in a few steps.
  const double size = std::cbrt(std::abs(glm::determinant(scale)));
  glm::dmat3 r = nearestRotation(scale / size);
  // A mirror is no rotation: its sign belongs to the scale.
  if (glm::determinant(r) < 0) r = -r;
  rotation = glm::normalize(glm::quat_cast(r));
  scale = glm::transpose(r) * scale;
}

AnimatedTransform::AnimatedTransform(const Transform& start, float startTime, const Transform& end,
                                     float endTime)
    : start_(start),
      end_(end),
      startTime_(startTime),
      endTime_(endTime),
      first_(start.matrix()),
      last_(end.matrix()) {}

glm::dmat4 AnimatedTransform::interpolated(double t) const {
  const glm::dmat3 linear = glm::mat3_cast(glm::slerp(first_.rotation, last_.rotation, t)) *
                            ((1 - t) * first_.scale + t * last_.scale);
  glm::dmat4 m(linear);
  m[3] = glm::dvec4((1 - t) * first_.translation + t * last_.translation, 1);
  return m;
}

Transform AnimatedTransform::at(float time) const {
  if (!(time > startTime_) || start_ == end_) return start_;
  if (time >= endTime_) return end_;
  const double span = static_cast<double>(endTime_) - static_cast<double>(startTime_);
  return Transform(glm::mat4(
      interpolated((static_cast<double>(time) - static_cast<double>(startTime_)) / span)));
}

Bounds3 AnimatedTransform::bounds(const Bounds3& box) const {
  if (box.empty()) return box;
  constexpr int kSteps = 32;
  const double angle =
      2 * std::acos(std::min(1., std::abs(glm::dot(first_.rotation, last_.rotation))));
  Bounds3 out;
  double stray = 0;
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 p(box.corner(i));
    for (int k = 0; k <= kSteps; ++k)
      out.extend(Vec3(interpolated(static_cast<double>(k) / kSteps) * glm::dvec4(p, 1)));
    // Between two steps the path strays from its chord by step² / 8 of its largest acceleration:
    // ω² |S p| + 2 ω |S' p|.
    const double reach = std::max(glm::length(first_.scale * p), glm::length(last_.scale * p));
    const double growth = glm::length(last_.scale * p - first_.scale * p);
    stray = std::max(stray, (angle * angle * reach + 2 * angle * growth) / (8 * kSteps * kSteps));
  }
  const Vec3 pad = Vec3(static_cast<float>(1.001 * stray)) +
                   roundingBound(4) * glm::max(absComponents(out.min), absComponents(out.max));
  out.min -= pad;
  out.max += pad;
  return out;
}

}  // namespace lampyris
