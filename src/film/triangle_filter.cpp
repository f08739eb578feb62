// SPDX-License-Identifier: Apache-2.0
#include "core/math.h"
#include "film/separable_filter.h"

namespace lampyris {

namespace {

struct TriangleFilterParameters {
  float xWidth = 2, yWidth = 2;
  void declare(Declaration& d) {
    d.add("xwidth", xWidth, "Half the width, in pixels.").range(kMinFilterWidth, kMaxFilterWidth);
    d.add("ywidth", yWidth, "Half the height, in pixels.").range(kMinFilterWidth, kMaxFilterWidth);
  }
};

/// Inverts the CDF of the tent over [−1, 1].
float sampleTent(float u) {
  return u < 0.5f ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(std::max(0.f, 2 - 2 * u));
}

class TriangleFilter final : public Filter {
 public:
  explicit TriangleFilter(const Vec2& radius) : radius_(radius) {}
  Vec2 radius() const override { return radius_; }
  float evaluate(const Vec2& offset) const override {
    return std::max(0.f, radius_.x - std::abs(offset.x)) *
           std::max(0.f, radius_.y - std::abs(offset.y));
  }
  FilterSample sample(const Vec2& u) const override {
    return {Vec2(sampleTent(u.x), sampleTent(u.y)) * radius_, 1};
  }

 private:
  Vec2 radius_;
};

std::unique_ptr<Filter> create(const TriangleFilterParameters& p, const FilterContext&) {
  return std::make_unique<TriangleFilter>(Vec2(p.xWidth, p.yWidth));
}

}  // namespace

FilterRegistry::Entry triangleFilterPlugin() {
  return makePlugin("triangle", "Falls off linearly in x and y.", create);
}

}  // namespace lampyris
