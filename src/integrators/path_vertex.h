// SPDX-License-Identifier: Apache-2.0
/// Vertices of paths that are made from both ends.
#pragma once

#include <deque>

#include "base/bsdf.h"
#include "base/light_distribution.h"
#include "base/medium.h"

namespace lampyris {

/// Densities are by area; that of a light at infinity, which has no place, by solid angle. Those of
/// a Dirac delta (specular scattering, lights of one point or direction) leave out the delta, which
/// all strategies that can make the path have in common.
struct PathVertex {
  enum class Kind : uint8_t { Camera, Light, Surface, Medium };

  Kind kind = Kind::Surface;
  /// Of a light or surface that has no place, and so sends its light along −at.wo.
  bool infinite = false;
  /// False: the path scatters here as only a sample can find, so that no edge may be drawn to it.
  bool connectible = true;
  LightId light = kNoLight;  ///< of a light
  /// Where; at.n = 0 for a point without surface. at.wo points to where its subpath comes from.
  SurfaceInteraction at;
  Bsdf bsdf;                       ///< of a surface
  const Medium* medium = nullptr;  ///< that its subpath comes through; null: none
  Rgb throughput{1};               ///< of the subpath up to here, over its density
  double forward = 0;              ///< density with which its own subpath drew it
  double reverse = 0;  ///< density with which the next vertex, looking back, would draw it

  bool isSurface() const { return kind == Kind::Surface; }

  // Of a surface or a point of a medium: BSDF and its cosine, or phase function and 1.
  Rgb f(const Vec3& wo, const Vec3& wi) const {
    return isSurface() ? bsdf.f(wo, wi) : Rgb(medium->phase().p(wo, wi));
  }
  float pdf(const Vec3& wo, const Vec3& wi) const {
    return isSurface() ? bsdf.pdf(wo, wi) : medium->phase().p(wo, wi);
  }
  float cosine(const Vec3& w) const { return isSurface() ? bsdf.absCosTheta(w) : 1; }
  /// What stands for the cosine where light comes from `in` and leaves towards `out`: sides by the
  /// geometric normal, which densities know, cosines by the shading normal (Veach 1997, §5.3).
  float importanceCosine(const Vec3& in, const Vec3& out) const;
  bool isSpecular() const { return isSurface() && bsdf.isSpecular(); }
  std::optional<BsdfSample> sample(float uc, const Vec2& u) const;
  /// Where light is sampled for it.
  LightSampleContext context() const;
  /// That a ray in the direction `w` from here goes through.
  const Medium* mediumTowards(const Vec3& w) const;
};

/// From a towards b, unit; not both are at infinity.
inline Vec3 direction(const PathVertex& a, const PathVertex& b) {
  if (a.infinite) return -a.at.wo;
  return b.infinite ? b.at.wo : normalize(b.at.p - a.at.p);
}

/// What `pdf`, with which `from` chooses the direction to `to` (a light at infinity: the place), is
/// as the density of `to`.
inline double densityAt(const PathVertex& to, const PathVertex& from, double pdf) {
  if (to.infinite) return pdf;
  const bool surface = to.at.n != Vec3(0);
  if (from.infinite) return surface ? pdf * static_cast<double>(absDot(to.at.n, from.at.wo)) : pdf;
  const glm::dvec3 d(to.at.p - from.at.p);
  const double squared = glm::dot(d, d);
  if (!(squared > 0)) return 0;
  const double cosine =
      surface ? std::abs(glm::dot(glm::dvec3(to.at.n), d)) / std::sqrt(squared) : 1;
  return pdf * cosine / squared;
}

/// A path from one end, of vertices that stay where they are while it grows.
class Subpath {
 public:
  size_t size() const { return size_; }
  PathVertex& operator[](size_t i) { return vertices_[i]; }
  const PathVertex& operator[](size_t i) const { return vertices_[i]; }
  PathVertex& back() { return vertices_[size_ - 1]; }
  void clear() { size_ = 0; }
  /// The vertex that grow() is to append, as an earlier path left it.
  PathVertex& spare() {
    if (vertices_.size() == size_) vertices_.emplace_back();
    return vertices_[size_];
  }
  PathVertex& grow() {
    PathVertex& v = spare();
    ++size_;
    return v;
  }

 private:
  std::deque<PathVertex> vertices_;
  size_t size_ = 0;
};

}  // namespace lampyris
