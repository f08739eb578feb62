// SPDX-License-Identifier: Apache-2.0
/// The next direction of a path: from the BSDF or phase function, or from a guide.
#pragma once

#include "base/bsdf.h"
#include "guiding/guide.h"

namespace lampyris {

/// What scatters light at a vertex of a path: a surface's BSDF or a medium's phase function.
class ScatteringPoint final : public DirectionWeight {
 public:
  ScatteringPoint(const Bsdf& bsdf, const Vec3& wo) : bsdf_(&bsdf), wo_(wo) {}
  ScatteringPoint(const PhaseFunction& phase, const Vec3& wo) : phase_(&phase), wo_(wo) {}

  /// BSDF × |cos|, or the phase function.
  Rgb scattered(const Vec3& wi) const {
    return bsdf_ ? bsdf_->f(wo_, wi) * bsdf_->absCosTheta(wi) : Rgb(phase_->p(wo_, wi));
  }
  float weight(const Vec3& wi) const override { return scattered(wi).luminance(); }
  /// Of rough matte surfaces, which vary a little, what they scatter straight up.
  float even() const override {
    if (phase_) return phase_->isIsotropic() ? phase_->p(wo_, wo_) : -1;
    if (!bsdf_->isDiffuse() || bsdf_->transmits()) return -1;
    return bsdf_->f(wo_, faceForward(bsdf_->frame().z, wo_)).luminance();
  }
  float pdf(const Vec3& wi) const { return bsdf_ ? bsdf_->pdf(wo_, wi) : phase_->p(wo_, wi); }
  const Bsdf* bsdf() const { return bsdf_; }
  const PhaseFunction* phase() const { return phase_; }
  const Vec3& wo() const { return wo_; }

 private:
  const Bsdf* bsdf_ = nullptr;
  const PhaseFunction* phase_ = nullptr;
  Vec3 wo_;
};

/// A direction drawn from a DirectionMixture.
struct DrawnDirection {
  Vec3 wi{0};
  Rgb scattered;  ///< ScatteringPoint::scattered(), or what makes scattered / pdf the weight
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
  DirectionMixture(const ScatteringPoint& at, const LocalGuide* guide, float ownShare)
      : at_(at), guide_(guide), ownShare_(guide ? ownShare : 1) {}

  /// The density that light sampling is weighed against: of the point's own draws among all. To
  /// leave out the guide's share is as unbiased, since both techniques weigh so, and saves its
  /// evaluation; guides are for light that light sampling does not find.
  float weighingPdf(float ownPdf) const { return ownShare_ * ownPdf; }
  /// None where nothing is scattered.
  std::optional<DrawnDirection> sample(float uc, const Vec2& u, NumberSequence& more) const;

 private:
  float mixed(float ownPdf, float guidePdf) const {
    return guide_ ? ownShare_ * ownPdf + (1 - ownShare_) * guidePdf : ownPdf;
  }
  float guidePdf(const Vec3& wi) const { return guide_ ? guide_->pdf(wi) : -1; }
  void set(DrawnDirection& d, const Vec3& wi, const Rgb& scattered, float ownPdf) const;
  void sampleOwn(DrawnDirection& d, float uc, const Vec2& u) const;

  const ScatteringPoint& at_;
  const LocalGuide* guide_;
  float ownShare_;
};

}  // namespace lampyris
