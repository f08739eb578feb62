// SPDX-License-Identifier: Apache-2.0
/// Affine and projective maps with their inverses.
#pragma once

#include <glm/mat4x4.hpp>

#include "core/bounds.h"
#include "core/vector.h"

namespace lampyris {

/// A 4×4 matrix (column vectors, as GLM stores it) and its inverse.
class Transform {
 public:
  Transform() : matrix_(1), inverse_(1) {}
  /// The inverse is computed in double precision. A singular matrix is kept, its inverse is zero:
  /// see isSingular().
  explicit Transform(const glm::mat4& matrix);
  Transform(const glm::mat4& matrix, const glm::mat4& inverse)
      : matrix_(matrix), inverse_(inverse) {}

  static Transform translate(const Vec3& by);
  static Transform scale(const Vec3& by);
  /// Rotation by `degrees` about `axis` (need not be unit; zero gives the identity).
  static Transform rotate(float degrees, const Vec3& axis);
  /// World to camera: the camera at `eye`, looking along +z at `target`, +y towards `up`
  /// (pbrt-v3, left-handed). Singular if the directions are parallel or `eye` is `target`.
  static Transform lookAt(const Vec3& eye, const Vec3& target, const Vec3& up);

  const glm::mat4& matrix() const { return matrix_; }
  const glm::mat4& inverseMatrix() const { return inverse_; }
  Transform inverse() const { return {inverse_, matrix_}; }
  bool isSingular() const;
  bool isIdentity() const { return matrix_ == glm::mat4(1); }
  bool operator==(const Transform& o) const { return matrix_ == o.matrix_; }
  /// True where a right-handed frame becomes left-handed.
  bool swapsHandedness() const;

  /// The product: `(a * b).point(p) == a.point(b.point(p))`.
  Transform operator*(const Transform& b) const {
    return {matrix_ * b.matrix_, b.inverse_ * inverse_};
  }

  /// Maps a position, divided by w where the map is projective.
  Vec3 point(const Vec3& p) const;
  /// The same for an affine map.
  Vec3 affinePoint(const Vec3& p) const {
    // In pairs: no term goes through more than three roundings, as pointError() counts.
    return (Vec3(matrix_[0]) * p.x + Vec3(matrix_[1]) * p.y) +
           (Vec3(matrix_[2]) * p.z + Vec3(matrix_[3]));
  }
  Vec3 vector(const Vec3& v) const {
    return Vec3(matrix_[0]) * v.x + Vec3(matrix_[1]) * v.y + Vec3(matrix_[2]) * v.z;
  }
  /// Maps a normal (by the inverse transpose; the length is not kept).
  Vec3 normal(const Vec3& n) const {
    return {dot(Vec3(inverse_[0]), n), dot(Vec3(inverse_[1]), n), dot(Vec3(inverse_[2]), n)};
  }
  /// The box of the mapped box.
  Bounds3 bounds(const Bounds3& b) const;
  /// Bounds of the absolute error of `affinePoint(p)`, given those of `p`.
  Vec3 pointError(const Vec3& p, const Vec3& pError) const;

 private:
  glm::mat4 matrix_, inverse_;
};

}  // namespace lampyris
