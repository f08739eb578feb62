// SPDX-License-Identifier: Apache-2.0
/// What a vertex of a path scatters, as guides ask for it.
#pragma once

#include "base/light_distribution.h"
#include "guiding/guide.h"

namespace lampyris {

class ScatteringPoint final : public DirectionWeight {
 public:
  /// at.scattered() must be known; `at` must live as long.
  explicit ScatteringPoint(const LightSampleContext& at) : at_(at) {}

  /// By the shapes of the BSDF's lobes, which takes a fraction of the time of the BSDF itself,
  /// where they tell of all of it.
  void weigh(std::span<const Vec3> wi, std::span<float> weights) const override;
  /// Of rough matte surfaces, which vary a little, what they scatter straight up.
  float even() const override;

 private:
  bool weighByShapes(std::span<const Vec3> wi, std::span<float> weights) const;

  const LightSampleContext& at_;
};

}  // namespace lampyris
