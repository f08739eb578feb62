// SPDX-License-Identifier: Apache-2.0
// Writes lightdistributions/brdf_pivot_data.inc: for nodes of roughness × view angle the pivot
// transformed lobe (brdf_pivot.h) that is nearest to a lobe of Trowbridge–Reitz microfacets.
//
// Nearest in the sense of ∫ |lobe − fit| over the hemisphere: half of that bounds the error of the
// integral over any set of directions. The fit always has the lobe's albedo; width and pivot angle
// are searched.
#include <fmt/core.h>

#include <vector>

#include "core/parallel.h"
#include "lightdistributions/brdf_pivot_table.h"
#include "materials/trowbridge_reitz.h"

namespace lampyris {

namespace {

/// Points of quadrature an axis.
constexpr int kGrid = 200;

/// A lobe on points that lie where it is: evenly over the sphere as a pivot lobe about the mirror
/// direction sees it.
class SampledLobe {
 public:
  SampledLobe(float alpha, float viewAngle);
  /// ∫ |lobe − fit| / ∫ lobe.
  float error(float width, float pivotAngle) const;

 private:
  struct Point {
    Vec3 w;
    float value;   ///< BRDF × cosine
    float weight;  ///< solid angle
  };
  std::vector<Point> points_;
  float integral_ = 0;
};

/// ∫ lobe, by drawing visible facets: more precise at grazing angles than the points above.
float albedoOf(float alpha, float viewAngle) {
  const TrowbridgeReitz facets(alpha, alpha);
  const Vec3 wo(std::sin(viewAngle), 0, std::cos(viewAngle));
  double sum = 0;
  for (int i = 0; i < kGrid; ++i) {
    for (int j = 0; j < kGrid; ++j) {
      const Vec2 u(Vec2(static_cast<float>(i) + 0.5f, static_cast<float>(j) + 0.5f) / float{kGrid});
      const Vec3 m = facets.sampleVisible(wo, u), w = 2 * dot(wo, m) * m - wo;
      if (w.z > 0)
        sum += static_cast<double>(4 * facets.visibilityOver4Cosines(wo, w) * w.z /
                                   facets.visibilityOverCosine(wo));
    }
  }
  return static_cast<float>(sum / (kGrid * kGrid));
}

SampledLobe::SampledLobe(float alpha, float viewAngle) {
  const TrowbridgeReitz facets(alpha, alpha);
  const Vec3 wo(std::sin(viewAngle), 0, std::cos(viewAngle));
  const Frame pivot = Frame::fromZ({-wo.x, 0, wo.z});
  const double k = 1 / static_cast<double>(PivotTable::meanWidth(alpha, wo.z)), g = (k + 1 / k) / 2,
               gb = (k - 1 / k) / 2;
  double sum = 0;
  for (int i = 0; i < kGrid; ++i) {
    for (int j = 0; j < kGrid; ++j) {
      // The inverse boost takes the even point (sin, cos, φ) to where the lobe is dense.
      const double z = 1 - (2 * i + 1.) / kGrid,
                   phi = 2 * static_cast<double>(kPi) * (j + .5) / kGrid;
      const double back = g + gb * z, sine = std::sqrt(1 - z * z) / back;
      const Vec3 w = pivot.toWorld({static_cast<float>(sine * std::cos(phi)),
                                    static_cast<float>(sine * std::sin(phi)),
                                    static_cast<float>((gb + g * z) / back)});
      if (!(w.z > 0)) continue;
      const Vec3 m = normalize(wo + w);
      const float value = facets.density(m) * facets.visibilityOver4Cosines(wo, w) * w.z;
      const double weight = 4 * static_cast<double>(kPi) / (kGrid * kGrid * back * back);
      points_.push_back({w, value, static_cast<float>(weight)});
      sum += static_cast<double>(value) * weight;
    }
  }
  integral_ = static_cast<float>(sum);
}

float SampledLobe::error(float width, float pivotAngle) const {
  const PivotLobe fit({-std::sin(pivotAngle), 0, std::cos(pivotAngle)}, width, {0, 0, 1},
                      integral_);
  double sum = 0;
  for (const Point& p : points_)
    sum += static_cast<double>(std::abs(p.value - fit.density(p.w)) * p.weight);
  return static_cast<float>(sum / static_cast<double>(integral_));
}

struct Shape {
  float width, angle, error;
};

/// The nearest fit by compass search from a start.
Shape search(const SampledLobe& lobe, float width, float angle) {
  Shape best{width, angle, lobe.error(width, angle)};
  for (float step = 0.5f; step > 1e-3f; step *= 0.5f) {
    for (bool moved = true; moved;) {
      moved = false;
      const auto tryAt = [&](float w, float a) {
        w = std::clamp(w, 1e-4f, 1.f);
        // At normal incidence the lobe is symmetric.
        a = angle > 0 ? std::min(a, 0.5f * kPi) : 0.f;
        const float e = lobe.error(w, a);
        if (e >= best.error) return;
        best = {w, a, e};
        moved = true;
      };
      tryAt(best.width * (1 + step), best.angle);
      tryAt(best.width / (1 + step), best.angle);
      tryAt(best.width, best.angle + step * best.width);
      tryAt(best.width, best.angle - step * best.width);
    }
  }
  return best;
}

PivotFit fit(float alpha, float viewAngle) {
  const SampledLobe lobe(alpha, viewAngle);
  const float mean = PivotTable::meanWidth(alpha, std::cos(viewAngle));
  const float width = std::min(mean, 1.f);
  Shape best = search(lobe, width, viewAngle);
  // Very rough lobes lie nearly about the normal, and a start from a uniform density gets nowhere.
  if (width > 0.3f) {
    const Shape other = search(lobe, 0.5f, 0.2f * viewAngle);
    if (other.error < best.error) best = other;
  }
  const float lean = viewAngle > 0 ? best.angle / viewAngle - 1 : 0;
  return {albedoOf(alpha, viewAngle), best.width / mean, lean, best.error};
}

}  // namespace

void fitAll() {
  constexpr size_t kAngles = PivotTable::kAngles;
  std::vector<PivotFit> fits(PivotTable::kRoughnesses * kAngles);
  parallelFor(fits.size(), 1, [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i)
      fits[i] = fit(PivotTable::alphaAt(i / kAngles), PivotTable::angleAt(i % kAngles));
  });
  fmt::print(
      "// SPDX-License-Identifier: Apache-2.0\n"
      "// Made by the program fit_lobes: albedo, width, lean, error. clang-format off\n");
  for (size_t i = 0; i < PivotTable::kRoughnesses; ++i) {
    fmt::print("{{{{\n");
    // The lean at normal incidence is that of angles near to it.
    fits[i * kAngles].lean = fits[i * kAngles + 1].lean;
    for (size_t j = 0; j < kAngles; ++j) {
      const PivotFit& f = fits[i * kAngles + j];
      fmt::print("{{{:.4f}f, {:.4f}f, {:.5f}f, {:.4f}f}},{}", f.albedo, f.width, f.lean, f.error,
                 j % 3 == 2 || j + 1 == kAngles ? "\n" : " ");
    }
    fmt::print("}}}},\n");
  }
}

}  // namespace lampyris

int main() { lampyris::fitAll(); }
