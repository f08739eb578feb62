// SPDX-License-Identifier: Apache-2.0
// A medium that is the same everywhere. Distances are drawn in proportion to the transmittance of
// one channel; the weight is that of the mixture over the channels, as in pbrt-v3.
#include "core/sampling.h"
#include "media/coefficients.h"
#include "media/henyey_greenstein.h"

namespace lampyris {

namespace {

class HomogeneousMedium final : public Medium {
 public:
  explicit HomogeneousMedium(const MediumCoefficients& c)
      : scattering_(c.scattering), extinction_(c.extinction()), phase_(c.g) {}

  MediumSample sample(const Ray& ray, NumberSequence& numbers, TrackingCounts&) const override {
    const float channel = 3 * numbers.next();
    const float sigma = channel < 1 ? extinction_.r : channel < 2 ? extinction_.g : extinction_.b;
    const float t = sampleExponential(numbers.next()) / sigma;  // σ = 0: infinite or, by 0/0, NaN
    MediumSample s;
    s.scatters = t < ray.tMax;
    const Rgb left = transmittanceOver(s.scatters ? t : ray.tMax);
    const Rgb density = s.scatters ? extinction_ * left : left;
    const float mean = (density.r + density.g + density.b) / 3;
    s.t = t;
    if (!(mean > 0) || !std::isfinite(mean)) {
      s.weight = Rgb();  // drawn by no channel but through rounding
    } else {
      s.weight = (s.scatters ? scattering_ * left : left) / mean;
    }
    return s;
  }

  Rgb transmittance(const Ray& ray, NumberSequence&, TrackingCounts&) const override {
    return transmittanceOver(ray.tMax);
  }
  const PhaseFunction& phase() const override { return phase_; }

 private:
  /// A channel without extinction lets everything through, over infinite distances too.
  Rgb transmittanceOver(float distance) const {
    const float d = std::min(distance, std::numeric_limits<float>::max());
    return exp(-d * extinction_);
  }

  Rgb scattering_, extinction_;
  HenyeyGreenstein phase_;
};

std::unique_ptr<Medium> create(const CoefficientParameters& p, const MediumContext& context) {
  return std::make_unique<HomogeneousMedium>(p.resolve(context));
}

}  // namespace

MediumRegistry::Entry homogeneousMediumPlugin() {
  return makePlugin("homogeneous", "A medium that is the same everywhere.", create);
}

}  // namespace lampyris
