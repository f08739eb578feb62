// SPDX-License-Identifier: Apache-2.0
#include "film/separable_filter.h"

namespace lampyris {

namespace {

struct GaussianParameters {
  float xWidth = 2, yWidth = 2, alpha = 2;
  void declare(Declaration& d) {
    d.add("xwidth", xWidth, "Half the width, in pixels.").range(kMinFilterWidth, kMaxFilterWidth);
    d.add("ywidth", yWidth, "Half the height, in pixels.").range(kMinFilterWidth, kMaxFilterWidth);
    d.add("alpha", alpha, "Rate of the fall-off: exp(-alpha x^2).").range(1e-6, 1e6);
  }
};

/// exp(−α x²) − exp(−α r²).
class GaussianAxis {
 public:
  GaussianAxis(double radius, double alpha)
      : radius_(radius), alpha_(alpha), edge_(std::exp(-alpha * radius * radius)) {}
  double radius() const { return radius_; }
  /// Beyond exp(−80) nothing reaches a float sum.
  double tableRadius() const { return std::min(radius_, std::sqrt(80 / alpha_)); }
  size_t cells() const { return 128; }
  double operator()(double x) const {
    if (!(std::abs(x) < radius_)) return 0;
    const double toEdge = alpha_ * (radius_ * radius_ - x * x);
    // A wide, flat bell is a small difference of two exponentials.
    return toEdge < 1 ? edge_ * std::expm1(toEdge) : std::exp(-alpha_ * x * x) - edge_;
  }

 private:
  double radius_, alpha_, edge_;
};

std::unique_ptr<Filter> create(const GaussianParameters& p, const FilterContext&) {
  const auto alpha = static_cast<double>(p.alpha);
  return std::make_unique<SeparableFilter<GaussianAxis>>(
      GaussianAxis(static_cast<double>(p.xWidth), alpha),
      GaussianAxis(static_cast<double>(p.yWidth), alpha));
}

}  // namespace

FilterRegistry::Entry gaussianFilterPlugin() {
  return makePlugin("gaussian", "A Gaussian bell, lowered to reach 0 at its edge.", create);
}

}  // namespace lampyris
