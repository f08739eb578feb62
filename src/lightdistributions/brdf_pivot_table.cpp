// SPDX-License-Identifier: Apache-2.0
#include "lightdistributions/brdf_pivot_table.h"

namespace lampyris {

namespace {

constexpr float kMinWidth = 5e-4f;

/// Where between which nodes: x in [0, count − 1].
struct Position {
  size_t node;
  float share;  ///< of the next node
  Position(float x, size_t count) {
    const float inRange = std::min(std::max(0.f, x), static_cast<float>(count - 1));
    node = std::min(static_cast<size_t>(inRange), count - 2);
    share = inRange - static_cast<float>(node);
  }
};

/// The direction at an angle to n, in the plane of wo and n on wo's other side.
Vec3 mirrored(const Vec3& wo, const Vec3& n, float sine, float cosine) {
  const Vec3 away = normalize(dot(wo, n) * n - wo);
  return normalize(sine * away + cosine * n);
}

float widthInRange(float width) { return std::clamp(width, kMinWidth, 1.f); }

}  // namespace

const std::array<std::array<PivotFit, PivotTable::kAngles>, PivotTable::kRoughnesses>&
PivotTable::data() {
  static constexpr std::array<std::array<PivotFit, kAngles>, kRoughnesses> kData = {{
#include "lightdistributions/brdf_pivot_data.inc"
  }};
  return kData;
}

float PivotTable::alphaAt(size_t i) {
  const float t = static_cast<float>(i) / (kRoughnesses - 1);
  return sqr(lerp(t, std::sqrt(kMinAlpha), std::sqrt(kMaxAlpha)));
}

float PivotTable::angleAt(size_t j) {
  return 0.5f * kPi * std::min(static_cast<float>(j) / (kAngles - 1), 0.99f);
}

float PivotTable::meanWidth(float alpha, float cosView) {
  return alpha * std::sqrt(std::max(cosView, 0.01f));
}

PivotFit PivotTable::lookup(float alpha, float viewAngle) {
  const float low = std::sqrt(kMinAlpha), high = std::sqrt(kMaxAlpha);
  const Position a((std::sqrt(alpha) - low) / (high - low) * (kRoughnesses - 1), kRoughnesses);
  const Position v(viewAngle * (2 * kInvPi) * (kAngles - 1), kAngles);
  const auto& rows = data();
  const auto at = [&](float PivotFit::*value) {
    const auto& r0 = rows[a.node];
    const auto& r1 = rows[a.node + 1];
    return lerp(a.share, lerp(v.share, r0[v.node].*value, r0[v.node + 1].*value),
                lerp(v.share, r1[v.node].*value, r1[v.node + 1].*value));
  };
  return {at(&PivotFit::albedo), at(&PivotFit::width), at(&PivotFit::lean), at(&PivotFit::error)};
}

PivotLobe reflectionLobe(const Vec3& wo, const Vec3& n, float alpha, float factor) {
  const float cosView = std::clamp(dot(wo, n), 0.f, 1.f), angle = std::acos(cosView);
  const PivotFit fit = PivotTable::lookup(alpha, angle);
  const float tilt = std::min(angle * (1 + fit.lean), 0.5f * kPi);
  const float width = widthInRange(fit.width * PivotTable::meanWidth(alpha, cosView));
  return {mirrored(wo, n, std::sin(tilt), std::cos(tilt)), width, n, factor * fit.albedo};
}

// A facet tilted by δ turns the refracted direction by δ |cos θt − cos θo / η| across the plane of
// incidence, and by 1 / cos θt times that within (Snell's law).
PivotLobe refractionLobe(const Vec3& wo, const Vec3& n, float alpha, float eta, float factor) {
  const float cosO = std::clamp(dot(wo, n), 0.f, 1.f);
  const float sinT = std::min(std::sqrt(1 - cosO * cosO) / eta, 1.f);
  const float cosT = std::sqrt(1 - sinT * sinT);
  const float turn = std::abs(cosT - cosO / eta) / std::sqrt(std::max(cosT, 0.01f));
  return {mirrored(wo, n, sinT, -cosT), widthInRange(0.5f * alpha * turn), -n, factor};
}

}  // namespace lampyris
