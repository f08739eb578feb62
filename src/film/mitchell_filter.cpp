// SPDX-License-Identifier: Apache-2.0
// Mitchell and Netravali 1988, "Reconstruction Filters in Computer Graphics", eq. 8. Weights are
// negative where the filter is.
#include "film/separable_filter.h"

namespace lampyris {

namespace {

struct MitchellParameters {
  float xWidth = 2, yWidth = 2, b = 1 / 3.f, c = 1 / 3.f;
  void declare(Declaration& d) {
    d.add("xwidth", xWidth, "Half the width, in pixels.").range(kMinFilterWidth, kMaxFilterWidth);
    d.add("ywidth", yWidth, "Half the height, in pixels.").range(kMinFilterWidth, kMaxFilterWidth);
    d.add("B", b, "Blur; B + 2C = 1 is recommended.").range(-10, 10);
    d.add("C", c, "Ringing.").range(-10, 10);
  }
};

/// The two cubics on t = 2|x| / radius in [0, 1] and [1, 2], as polynomials in Horner's form.
class MitchellAxis {
 public:
  MitchellAxis(double radius, double b, double c)
      : radius_(radius),
        inner_{(6 - 2 * b) / 6, 0, (-18 + 12 * b + 6 * c) / 6, (12 - 9 * b - 6 * c) / 6},
        outer_{(8 * b + 24 * c) / 6, (-12 * b - 48 * c) / 6, (6 * b + 30 * c) / 6,
               (-b - 6 * c) / 6} {}
  double radius() const { return radius_; }
  double tableRadius() const { return radius_; }
  size_t cells() const { return 128; }  // a multiple of 4: the cubics meet at cell borders
  double operator()(double x) const {
    const double t = 2 * std::abs(x) / radius_;
    if (!(t < 2)) return 0;
    const double* p = t < 1 ? inner_ : outer_;
    return p[0] + t * (p[1] + t * (p[2] + t * p[3]));
  }

 private:
  double radius_;
  double inner_[4], outer_[4];
};

std::unique_ptr<Filter> create(const MitchellParameters& p, const FilterContext&) {
  const auto b = static_cast<double>(p.b), c = static_cast<double>(p.c);
  return std::make_unique<SeparableFilter<MitchellAxis>>(
      MitchellAxis(static_cast<double>(p.xWidth), b, c),
      MitchellAxis(static_cast<double>(p.yWidth), b, c));
}

}  // namespace

FilterRegistry::Entry mitchellFilterPlugin() {
  return makePlugin("mitchell", "Mitchell and Netravali's cubic: sharp, slightly ringing.", create);
}

}  // namespace lampyris
