// SPDX-License-Identifier: Apache-2.0
/// Vectors: GLM's types under the project's names. A point, a direction and a normal are all Vec3;
/// what they are is said by the Transform method that maps them.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace lampyris {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Int2 = glm::ivec2;
using glm::cross;
using glm::dot;

inline float lengthSquared(const Vec3& v) { return dot(v, v); }
inline float length(const Vec3& v) { return std::sqrt(dot(v, v)); }
inline float distance(const Vec3& a, const Vec3& b) { return length(a - b); }
inline float absDot(const Vec3& a, const Vec3& b) { return std::abs(dot(a, b)); }
inline float maxComponent(const Vec3& v) { return std::max(v.x, std::max(v.y, v.z)); }
/// Per component. GLM's compiles to branches, which nothing can predict where signs are random.
template <glm::length_t N, class T>
glm::vec<N, T> absComponents(glm::vec<N, T> v) {
  for (glm::length_t i = 0; i < N; ++i) v[i] = std::abs(v[i]);
  return v;
}
inline bool isFinite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// The unit vector along `v`; the zero vector where `v` has no direction (zero or not finite).
/// Neither 1e-30 nor 1e+30 loses its direction: where the square leaves the range of floats, the
/// vector is scaled by its largest component first.
inline Vec3 normalize(const Vec3& v) {
  const float square = dot(v, v);
  if (square > 1e-30f && square < 1e30f) return v * (1 / std::sqrt(square));
  const Vec3 a = absComponents(v);
  const float scale = std::max(a.x, std::max(a.y, a.z));
  if (!(scale > 0) || !isFinite(v)) return Vec3(0);
  const Vec3 w = v / scale;
  return w / length(w);
}

/// `n`, or −`n` where that lies in the hemisphere of `v`.
inline Vec3 faceForward(const Vec3& n, const Vec3& v) { return dot(n, v) < 0 ? -n : n; }

}  // namespace lampyris
