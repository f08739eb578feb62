// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "guiding/guide.h"

namespace lampyris::test {

/// Scatters as a function says.
class FunctionWeight final : public DirectionWeight {
 public:
  explicit FunctionWeight(std::function<float(const Vec3&)> weight, float even = -1)
      : weight_(std::move(weight)), even_(even) {}
  void weigh(std::span<const Vec3> wi, std::span<float> weights) const override {
    for (size_t i = 0; i < wi.size(); ++i) weights[i] = weight_(wi[i]);
  }
  float even() const override { return even_; }

 private:
  std::function<float(const Vec3&)> weight_;
  float even_;
};

}  // namespace lampyris::test
