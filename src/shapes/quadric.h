// SPDX-License-Identifier: Apache-2.0
/// What spheres, disks, cylinders and cones share: a parametric surface in object space under an
/// affine map.
#pragma once

#include <glm/mat3x3.hpp>

#include "base/shape.h"

namespace lampyris {

using DVec2 = glm::dvec2;
using DVec3 = glm::dvec3;

/// Object space is computed in double precision, so that rounding to float is the only error of a
/// hit point and neither far-away rays nor large coordinates lose it (pbrt-v3 bounds the error of
/// single precision instead).
///
/// Deviations from pbrt-v3, where its own sampling and intersection disagree: normals of mirrored
/// shapes are those that its sampling has (outward unless ReverseOrientation), partial shapes are
/// sampled where they are, and areas are true areas under any transformation.
class Quadric : public Shape {
 public:
  Bounds3 bounds(uint32_t element) const final;
  void surface(uint32_t element, const ShapeHit& hit, const Ray& ray, SurfaceDetail detail,
               SurfaceInteraction& out) const override;
  float area(uint32_t element) const final { return (void)element, area_; }
  /// Uniform in object space, so by pdfArea() in world space.
  std::optional<ShapeSample> sampleArea(uint32_t element, const Vec2& u) const final;
  float pdfArea(uint32_t element, const Vec3& n) const final;

 protected:
  /// A point of the surface in object space: `n` is unit, along cross(dpdu, dpdv).
  struct Point {
    DVec3 p{0}, n{0, 0, 1}, dpdu{0}, dpdv{0}, dpduu{0}, dpduv{0}, dpdvv{0};
  };
  struct ObjectRay {
    DVec3 o, d;
    double tMax;
  };

  /// Throws SceneError if the transformation is singular or projective. `name` for messages.
  Quadric(const ShapeContext& context, const char* name);
  /// What is known of the shape when its parameters are set; `area` 0: nothing is there.
  struct Extent {
    double area = 0;
    DVec3 min{0}, max{0};     ///< a box around it,
    double axisRadius = 0;    ///< its largest distance from the z axis
    double originRadius = 0;  ///< and from the origin, all in object space
  };
  void finish(const Extent& extent);

  virtual Point evaluate(DVec2 uv) const = 0;
  /// Parameters of a point that is uniform by area in object space.
  virtual DVec2 sampleParameters(const Vec2& u) const = 0;

  ObjectRay toObject(const Ray& ray) const {
    return {objectPoint(ray.o), objectVector(ray.d), static_cast<double>(ray.tMax)};
  }
  DVec3 objectPoint(const Vec3& p) const { return toObject_ * (DVec3(p) - translation_); }
  DVec3 objectVector(const Vec3& v) const { return toObject_ * DVec3(v); }
  DVec3 toWorld(const DVec3& p) const { return matrix_ * p + translation_; }
  ShapeSample sampleAt(DVec2 uv) const;
  bool isEmpty() const { return !(objectArea_ > 0); }
  /// The common scale factor, or 0 if the axes are scaled differently or sheared.
  double similarity() const { return similarity_; }
  float orientation() const { return orientation_; }
  const glm::dmat3& matrix() const { return matrix_; }
  /// Under a similarity: M Mᵀ n / s², which is n but for what rounding of the map is off by.
  DVec3 corrected(const DVec3& n) const {
    return exact_ ? n : matrix_ * (n * matrix_) / sqr(similarity_);
  }
  /// In world space, of a shape that is a whole ball; else 0.
  double ballRadius() const { return ballRadius_; }
  void setBallRadius(double radius) { ballRadius_ = radius; }
  const DVec3& worldOrigin() const { return translation_; }
  /// Unit; turned over by ReverseOrientation.
  Vec3 worldNormal(const DVec3& objectNormal) const;

  /// Bounds of the rounding error of a point of the shape, toWorld(·) rounded to float.
  Vec3 worldError(const Vec3& world) const {
    // Half a spacing of floats is kMachineEpsilon at most.
    return mapError_ + (kMachineEpsilon * 1.001f) * absComponents(world);
  }

 private:
  double meanAreaScale() const;
  void setBounds(const Extent& extent);
  double areaScale(const DVec3& objectNormal) const;

  // What sampling reads of one of many small spheres comes first: a cache line.
  float area_ = 0, orientation_ = 1;
  Vec3 mapError_{0};   ///< of toWorld() in double precision, anywhere on the shape
  bool exact_ = true;  ///< corrected() changes nothing that a float could tell
  DVec3 translation_{0};
  double ballRadius_ = 0;

  glm::dmat3 matrix_{1}, toObject_{1};
  double determinant_ = 1, similarity_ = 0, objectArea_ = 0;
  Bounds3 bounds_;
};

/// An angle of a scene file in degrees, clamped to [0, 360], in radians.
double sweepAngle(float degrees);
/// The azimuth of (x, y) in [0, 2π).
double azimuth(double x, double y);
/// The box of the arc of a circle about the z axis with azimuth in [0, phiMax].
void arcBounds(double radius, double phiMax, DVec2& min, DVec2& max);
/// The parameters at which a t² + 2 halfB t + c = 0 in ascending order, given the discriminant
/// halfB² − a c as precisely as the caller has it; without cancellation. Where a = 0 one of them is
/// not finite.
struct Roots {
  int count = 0;
  double t[2] = {0, 0};
};
inline Roots quadraticRoots(double a, double halfB, double c, double discriminant) {
  if (!(discriminant >= 0)) return {};
  const double q = -(halfB + std::copysign(std::sqrt(discriminant), halfB));
  Roots r;
  r.count = 2;
  r.t[0] = q / a;
  r.t[1] = q != 0 ? c / q : 0;
  if (r.t[0] > r.t[1]) std::swap(r.t[0], r.t[1]);
  return r;
}

}  // namespace lampyris
