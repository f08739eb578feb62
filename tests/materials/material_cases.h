// SPDX-License-Identifier: Apache-2.0
/// Materials to test: every registered one with its defaults, and variants.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "support/resolvers.h"

namespace lampyris::test {

struct MaterialCase {
  std::string plugin;
  TestParameters::List parameters;
  /// Index of refraction of its rough transmission.
  float eta = 1.5f;
  /// Quadrature points a cell and direction: more for narrow lobes.
  int subdivisions = 12;
  bool reciprocal = true;
  /// The largest albedo that the model itself has.
  float largestAlbedo = 1;

  std::string label() const;
};
/// What GoogleTest prints of it.
inline void PrintTo(const MaterialCase& c, std::ostream* out) { *out << c.label(); }
/// The parameters that have no default.
TestParameters::List neededParameters(const std::string& plugin);
/// The defaults of every registered material, then variants.
std::vector<MaterialCase> materialCases();

/// Owns a material with all that it refers to. Known are the textures "half" (float 0.5), "nan",
/// "checks" (colour by u), and the named materials "diffuse", "mirror", "coat", "rough glass".
class MaterialFixture {
 public:
  explicit MaterialFixture(const MaterialCase& c);
  MaterialFixture(const std::string& plugin, const TestParameters::List& parameters)
      : MaterialFixture(MaterialCase{plugin, parameters}) {}

  const Material& operator*() const { return *material_; }
  const Material* operator->() const { return material_.get(); }
  TestBuild& build() { return build_; }
  /// The BSDF at a point of a tilted surface, shading and geometric normal the same.
  void evaluate(Bsdf& bsdf) const;

 private:
  std::unique_ptr<Material> create(const MaterialCase& c);
  TestBuild build_;
  std::vector<std::unique_ptr<Material>> named_;
  std::unique_ptr<Material> material_;
};

/// A point of a tilted surface with skewed derivatives.
SurfaceInteraction tiltedSurface();
/// The direction at polar angle `degrees` from the frame's z and some azimuth, in world space.
Vec3 outgoing(const Bsdf& bsdf, float degrees, float azimuth = 35);

}  // namespace lampyris::test
