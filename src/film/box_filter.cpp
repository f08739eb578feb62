// SPDX-License-Identifier: Apache-2.0
#include "film/separable_filter.h"

namespace lampyris {

namespace {

struct BoxParameters {
  float xWidth = 0.5f, yWidth = 0.5f;
  void declare(Declaration& d) {
    d.add("xwidth", xWidth, "Half the width, in pixels.").range(kMinFilterWidth, kMaxFilterWidth);
    d.add("ywidth", yWidth, "Half the height, in pixels.").range(kMinFilterWidth, kMaxFilterWidth);
  }
};

class BoxFilter final : public Filter {
 public:
  explicit BoxFilter(const Vec2& radius) : radius_(radius) {}
  Vec2 radius() const override { return radius_; }
  float evaluate(const Vec2& offset) const override {
    return std::abs(offset.x) <= radius_.x && std::abs(offset.y) <= radius_.y ? 1.f : 0.f;
  }
  FilterSample sample(const Vec2& u) const override { return {(2.f * u - 1.f) * radius_, 1}; }

 private:
  Vec2 radius_;
};

std::unique_ptr<Filter> create(const BoxParameters& p, const FilterContext&) {
  return std::make_unique<BoxFilter>(Vec2(p.xWidth, p.yWidth));
}

}  // namespace

FilterRegistry::Entry boxFilterPlugin() {
  return makePlugin("box", "All samples of the pixel count alike.", create);
}

}  // namespace lampyris
