// SPDX-License-Identifier: Apache-2.0
#include "core/transform.h"

#include <cmath>
#include <glm/matrix.hpp>

#include "core/math.h"

namespace lampyris {

Transform::Transform(const glm::mat4& matrix) : matrix_(matrix), inverse_(0) {
  const glm::dmat4 inverse = glm::inverse(glm::dmat4(matrix));
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r)
      if (!std::isfinite(static_cast<float>(inverse[c][r]))) return;
  inverse_ = glm::mat4(inverse);
}

Transform Transform::translate(const Vec3& by) {
  glm::mat4 m(1), inv(1);
  m[3] = glm::vec4(by, 1);
  inv[3] = glm::vec4(-by, 1);
  return {m, inv};
}

Transform Transform::scale(const Vec3& by) {
  glm::mat4 m(1);
  for (int i = 0; i < 3; ++i) m[i][i] = by[i];
  return Transform(m);
}

Transform Transform::rotate(float degrees, const Vec3& axis) {
  const Vec3 a = normalize(axis);
  if (a == Vec3(0)) return {};
  const double angle = static_cast<double>(degrees) * (3.14159265358979323846 / 180);
  const double s = std::sin(angle), c = std::cos(angle);
  glm::dmat4 m(1);
  // Rodrigues: R = c I + (1 − c) a aᵀ + s [a]×.
  const glm::dvec3 d(a);
  const glm::dmat3 skew(0, d.z, -d.y, -d.z, 0, d.x, d.y, -d.x, 0);
  for (int col = 0; col < 3; ++col)
    for (int row = 0; row < 3; ++row)
      m[col][row] = (col == row ? c : 0) + (1 - c) * d[col] * d[row] + s * skew[col][row];
  const glm::mat4 f(m);
  return {f, glm::transpose(f)};
}

Transform Transform::lookAt(const Vec3& eye, const Vec3& target, const Vec3& up) {
  const Vec3 z = normalize(target - eye);
  const Vec3 x = normalize(cross(normalize(up), z));
  const Vec3 y = cross(z, x);
  glm::mat4 cameraToWorld(1);
  cameraToWorld[0] = glm::vec4(x, 0);
  cameraToWorld[1] = glm::vec4(y, 0);
  cameraToWorld[2] = glm::vec4(z, 0);
  cameraToWorld[3] = glm::vec4(eye, 1);
  return Transform(cameraToWorld).inverse();
}

bool Transform::isSingular() const { return inverse_ == glm::mat4(0) || matrix_ == glm::mat4(0); }

bool Transform::swapsHandedness() const {
  return glm::determinant(glm::dmat3(glm::mat3(matrix_))) < 0;
}

Vec3 Transform::point(const Vec3& p) const {
  const glm::vec4 h = matrix_ * glm::vec4(p, 1);
  return h.w == 1 ? Vec3(h) : Vec3(h) / h.w;
}

Bounds3 Transform::bounds(const Bounds3& b) const {
  if (b.empty()) return b;
  Bounds3 out;
  for (int i = 0; i < 8; ++i) out.extend(point(b.corner(i)));
  return out;
}

Vec3 Transform::pointError(const Vec3& p, const Vec3& pError) const {
  Vec3 out;
  for (int r = 0; r < 3; ++r) {
    const Vec3 row = absComponents(Vec3(matrix_[0][r], matrix_[1][r], matrix_[2][r]));
    out[r] = (1 + roundingBound(3)) * dot(row, pError) +
             roundingBound(3) * (dot(row, absComponents(p)) + std::abs(matrix_[3][r]));
  }
  return out;
}

}  // namespace lampyris
