// SPDX-License-Identifier: Apache-2.0
// The phase function of Henyey and Greenstein 1941: p = (1 − g²) / (4π (1 + g² + 2 g cos θ)^1.5),
// θ between wo and wi, which both point away; g > 0 scatters forwards (wi near −wo).
#pragma once

#include "base/medium.h"
#include "core/frame.h"

namespace lampyris {

class HenyeyGreenstein final : public PhaseFunction {
 public:
  /// `g` in (−1, 1): the mean cosine of the change of direction.
  explicit HenyeyGreenstein(float g) : g_(g) {}

  float p(const Vec3& wo, const Vec3& wi) const override {
    // 1 + g² + 2gc = (1 − |g|)² + 2|g| (1 ± c): |wo ± wi|² / 2 has digits where 1 ± c has none.
    const Vec3 chord = g_ > 0 ? wo + wi : wo - wi;
    const float a = std::abs(g_);
    const float d = sqr(1 - a) + a * lengthSquared(chord);
    return (1 - a) * (1 + a) / (4 * kPi * d * std::sqrt(d));
  }

  bool isIsotropic() const override { return g_ == 0; }
  Vec3 sample(const Vec3& wo, const Vec2& u) const override {
    const float cosine = deflection(u.x);  // to −wo
    const Frame frame = Frame::fromZ(-wo);
    return normalize(frame.toWorld(
        sphericalDirection(std::sqrt(std::max(0.f, 1 - cosine * cosine)), cosine, 2 * kPi * u.y)));
  }

 private:
  float deflection(float u) const {
    if (std::abs(g_) < 1e-3f) return 1 - 2 * u;  // the inversion below divides by g
    const float s = (1 - g_ * g_) / (1 + g_ - 2 * g_ * u);
    return std::clamp((1 + g_ * g_ - s * s) / (2 * g_), -1.f, 1.f);
  }
  float g_;
};

}  // namespace lampyris
