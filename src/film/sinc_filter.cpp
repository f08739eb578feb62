// SPDX-License-Identifier: Apache-2.0
// The ideal low-pass filter under a Lanczos window (Duchon 1979). Weights are negative where the
// filter is.
#include "film/separable_filter.h"

namespace lampyris {

namespace {

struct SincParameters {
  float xWidth = 4, yWidth = 4, tau = 3;
  void declare(Declaration& d) {
    d.add("xwidth", xWidth, "Half the width, in pixels.").range(kMinFilterWidth, kMaxFilterWidth);
    d.add("ywidth", yWidth, "Half the height, in pixels.").range(kMinFilterWidth, kMaxFilterWidth);
    d.add("tau", tau, "Where the window reaches 0 first, in pixels.").range(0.05, 1e6);
  }
};

double sinc(double x) {
  const double t = 3.14159265358979323846 * x;
  return std::abs(t) < 1e-5 ? 1 : std::sin(t) / t;
}

/// sinc(x) sinc(x / τ), 0 beyond the radius.
class SincAxis {
 public:
  SincAxis(double radius, double tau) : radius_(radius), tau_(tau) {}
  double radius() const { return radius_; }
  double tableRadius() const { return radius_; }
  /// Enough cells for every swing of the sine that is the faster.
  size_t cells() const {
    return static_cast<size_t>(std::ceil(std::max(64., 32 * radius_ / std::min(tau_, 1.))));
  }
  double operator()(double x) const { return std::abs(x) > radius_ ? 0 : sinc(x) * sinc(x / tau_); }

 private:
  double radius_, tau_;
};

std::unique_ptr<Filter> create(const SincParameters& p, const FilterContext&) {
  const auto tau = static_cast<double>(p.tau);
  return std::make_unique<SeparableFilter<SincAxis>>(SincAxis(static_cast<double>(p.xWidth), tau),
                                                     SincAxis(static_cast<double>(p.yWidth), tau));
}

}  // namespace

FilterRegistry::Entry sincFilterPlugin() {
  return makePlugin("sinc", "A sinc under a Lanczos window: sharpest, ringing.", create);
}

}  // namespace lampyris
