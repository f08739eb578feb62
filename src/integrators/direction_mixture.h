// SPDX-License-Identifier: Apache-2.0
/// The next direction of a path: from the BSDF or phase function, or from a guide.
#pragma once

#include "base/light_distribution.h"
#include "guiding/guide.h"

namespace lampyris {

/// A direction drawn from a DirectionMixture.
struct DrawnDirection {
  Vec3 wi{0};
  Rgb scattered;  ///< LightSampleContext::scattered(), or what makes scattered / pdf the weight
  float pdf = 0;
  float guidePdf = -1;  ///< of the guide; < 0: there is none
  float ownPdf = 0;     ///< of the point's own sampling; of a specular draw the share of its choice
  bool isSpecular = false;
  bool isTransmission = false;  ///< by the BSDF's own sampling
  float etaScale = 1;           ///< (ηt/ηi)² if transmitted
};

/// One-sample mixture (Veach 1997, §9.2.4) of a point's own sampling and a guide.
class DirectionMixture {
 public:
  /// `guide` null: the point's own sampling alone. `ownShare` in (0, 1].
  DirectionMixture(const LightSampleContext& at, const LocalGuide* guide, float ownShare)
      : at_(at), guide_(guide), ownShare_(guide ? ownShare : 1) {}

  /// Of the point's own draws among all. Light sampling is weighed against these alone: to leave
  /// out the guide's is as unbiased, since both techniques weigh so, and saves their evaluation;
  /// guides are for light that light sampling does not find.
  float ownShare() const { return ownShare_; }
  /// None where nothing is scattered.
  std::optional<DrawnDirection> sample(float uc, const Vec2& u, NumberSequence& more) const;

 private:
  float mixed(float ownPdf, float guidePdf) const {
    return guide_ ? ownShare_ * ownPdf + (1 - ownShare_) * guidePdf : ownPdf;
  }
  float guidePdf(const Vec3& wi) const { return guide_ ? guide_->pdf(wi) : -1; }
  void set(DrawnDirection& d, const Vec3& wi, const Rgb& scattered, float ownPdf) const;
  void sampleOwn(DrawnDirection& d, float uc, const Vec2& u) const;

  const LightSampleContext& at_;
  const LocalGuide* guide_;
  float ownShare_;
};

}  // namespace lampyris
