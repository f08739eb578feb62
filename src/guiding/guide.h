// SPDX-License-Identifier: Apache-2.0
/// Guides: distributions of directions that are learned while an image is rendered.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "base/integrator.h"
#include "base/medium.h"
#include "core/statistics.h"
#include "core/vector.h"

namespace lampyris {

/// A point that wants a direction.
struct GuidePoint {
  Vec3 p{0};
  /// Geometric normal on the side of wo, unit; zero in a medium.
  Vec3 n{0};
  bool transmits = false;  ///< light from behind the surface is scattered as well

  bool onSurface() const { return n != Vec3(0); }
};

/// What a point does with light from a direction.
class DirectionWeight {
 public:
  /// For each of `wi` about the luminance of BSDF × |cos|, or of the phase function; ≥ 0. It may be
  /// rough: what guides know is weighed by it. `weights` are as many.
  virtual void weigh(std::span<const Vec3> wi, std::span<float> weights) const = 0;
  /// What weigh() tells where it is the same for all directions; at a surface: over the cosine, and
  /// 0 below. < 0 where it varies.
  virtual float even() const { return -1; }

 protected:
  ~DirectionWeight() = default;
};

/// Radiance that a path found: what guides learn from. `radiance / pdf` estimates the integral of
/// the radiance over the directions.
struct GuideSample {
  Vec3 p{0}, n{0};  ///< as in GuidePoint, but n on the side of wi
  Vec3 wi{0};
  float radiance = 0;  ///< luminance; finite, ≥ 0
  float pdf = 0;       ///< by solid angle, with which wi was drawn; > 0
  float count = 1;     ///< like so many samples it counts
  /// Whether light sampling was tried there, and whether light arrived.
  bool lightTried = false, lightFound = false;
};

/// A guide's distribution at one point; one object serves a thread for all its points.
class LocalGuide {
 public:
  virtual ~LocalGuide() = default;
  /// Sets the point. False: nothing is known there.
  virtual bool moveTo(const GuidePoint& point, const DirectionWeight& scattering) = 0;
  /// A direction with exactly the density pdf(); `u` for the choice of a part, `v` for the
  /// direction, `more` where those do not suffice.
  virtual Vec3 sample(float u, const Vec2& v, NumberSequence& more) const = 0;
  virtual float pdf(const Vec3& wi) const = 0;
  /// Luminance that the point scatters of the light that is known; 0: not known.
  virtual float scattered() const { return 0; }
  /// In (0, 1]: the part of light samples that is worth taking, fewer where light hardly arrives.
  virtual float lightWorth() const { return 1; }
};

/// Frozen while a pass is rendered, changed by learn() between passes only.
class Guide {
 public:
  virtual ~Guide() = default;
  virtual std::unique_ptr<LocalGuide> makeLocal() const = 0;
  /// False: samples are not wanted, and the guide is ready before the first pass.
  virtual bool learns() const { return true; }
  /// Takes the samples of a part of a pass, in an order that is the same for any number of
  /// threads; then, once a pass, endPass().
  virtual void learn(std::span<const GuideSample> samples) = 0;
  virtual void endPass() = 0;
  virtual void report(Statistics& statistics) const = 0;
  /// What has been learned until the last endPass(), so that an equal guide goes on from it to the
  /// same bits. False: the bytes are not of such a guide, which must not be used then.
  virtual std::string save() const = 0;
  /// As in LearnedState.
  virtual std::vector<LearnedDirection> directions() const { return {}; }
  virtual bool restore(std::string_view bytes) = 0;
};

}  // namespace lampyris
