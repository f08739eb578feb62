// SPDX-License-Identifier: Apache-2.0
/// What point lights whose intensity depends on the direction by an image have in common.
#pragma once

#include <memory>
#include <string>

#include "base/light.h"
#include "core/transform.h"
#include "lights/cone_emission.h"
#include "lights/emission_image.h"

namespace lampyris {

struct PatternLightParameters {
  Rgb intensity{1}, scale{1};
  std::string map;

  void declare(Declaration& d);
};

/// At the origin of its space. Sends I × pattern(direction).
class PatternLight : public Light {
 public:
  /// Throws SceneError: `name` for messages.
  PatternLight(const PatternLightParameters& parameters, const LightContext& context,
               const std::string& name);

  bool isDelta() const final { return true; }
  std::optional<LightSample> sample(uint32_t element, const Vec3& from, const Vec2& u) const final;
  std::optional<EmissionSample> sampleEmission(uint32_t element, const Vec2& u,
                                               const Vec2& v) const final;
  EmissionPdf emissionPdf(uint32_t element, const Vec3& n, const Vec3& w) const final;

 protected:
  /// The factor on the intensity; `w` is unit, away from the light, in the light's space.
  virtual Rgb pattern(const Vec3& w) const = 0;

  /// A direction of the light's space in the world; not unit.
  Vec3 toWorld(const Vec3& w) const { return lightToWorld_.vector(w); }
  /// The world's solid angle that a solid angle about the direction `w` (of any length, in the
  /// light's space) becomes: |A w|⁻³ |w|³ × a constant. A transform may stretch it.
  double stretch(const Vec3& w) const;
  /// At the light's place, with the intensity I × `meanPattern`; emission in all directions.
  LightBounds boundsOf(const Rgb& meanPattern) const;
  /// A cone that holds all directions in which the pattern is not black; by default all.
  void emitWithin(const ConeEmission& cone) { emission_ = cone; }
  const Rgb& intensity() const { return intensity_; }
  const EmissionImage* image() const { return image_.get(); }  ///< null: none is named

 private:
  Transform lightToWorld_, worldToLight_;
  Vec3 p_;
  Rgb intensity_;
  std::shared_ptr<const EmissionImage> image_;
  ConeEmission emission_;
};

}  // namespace lampyris
