// SPDX-License-Identifier: Apache-2.0
// The integral. Let the plane turn about the line in which it meets the plane across the axis: the
// rim sweeps a great half circle on which (ω·a)ⁿ = (sin θ cos ψ)ⁿ, with the speed cos ψ, so
//
//   V(n, θ) = 2π/(n+1) − C(n+1) ∫₀^θ sinⁿt dt,   C(m) = ∫ cosᵐψ dψ over (−π/2, π/2).
//
// With the complementary integral from θ to π/2, integrated by parts, every term is positive:
//
//   (n+1) V = π + u(n),   u(n) = u(n−2) + C(n−1) cos θ sinⁿ⁻¹θ,
//   u(0) = π − 2θ,  u(1) = π cos θ,   C(m) = C(m−2) (m−1)/m,  C(0) = π,  C(1) = 2,
//
// for θ ≤ π/2; beyond, V(n, π − θ) = 2π/(n+1) − V(n, θ).
#include "guiding/clipped_lobe.h"

#include <array>

#include "core/frame.h"

namespace lampyris {

namespace {

constexpr double kPiD = 3.14159265358979323846;

/// u(n) above, for 0 ≤ c = cos θ ≤ 1.
double upperShare(uint32_t n, double c) {
  const double sine2 = (1 - c) * (1 + c);
  // Term of k: C(k−1) c sin^(k−1), k = n, n−2 …, from the smallest k on.
  uint32_t k = n % 2 ? 3 : 2;
  double u = n % 2 ? kPiD * c : 2 * std::asin(c);
  double term = c * (n % 2 ? kPiD / 2 * sine2 : 2 * std::sqrt(sine2));
  for (; k <= n; k += 2) {
    u += term;
    term *= sine2 * k / (k + 1.);
    if (term < 1e-17) break;
  }
  return std::min(u, kPiD);
}

/// (n+1) V / 2π, from ½ to 1 over the tilt, at the nodes of a cubic Hermite interpolation in cos θ.
/// Beyond cos θ = kReach/√n it is 1 to 1e-9.
class LobeTable {
 public:
  /// Below, the sum is as fast, and the slope at cos θ = 1 too steep to interpolate.
  static constexpr uint32_t kLeastExponent = 12;

  LobeTable() {
    for (int level = 0; level < kLobeLevels; ++level) {
      const uint32_t n = lobeExponent(level);
      if (n < kLeastExponent) continue;
      Row& row = rows_[static_cast<size_t>(level)];
      const double reach = std::min(1., kReach / std::sqrt(static_cast<double>(n)));
      const double step = reach / kIntervals;
      row.scale = static_cast<float>(1 / step);
      for (int i = 0; i <= kIntervals; ++i) {
        const double c = std::min(i * step, 1.);
        row.value[static_cast<size_t>(i)] =
            static_cast<float>((kPiD + upperShare(n, c)) / (2 * kPiD));
        row.slope[static_cast<size_t>(i)] = static_cast<float>(slope(n, c) * step);
      }
    }
  }

  float operator()(int level, float c) const {
    const Row& row = rows_[static_cast<size_t>(level)];
    const float x = c * row.scale;
    if (!(x < kIntervals)) return row.value[kIntervals];
    const auto i = static_cast<size_t>(x);
    const float t = x - static_cast<float>(i), t2 = t * t, t3 = t2 * t;
    const float rise = row.value[i + 1] - row.value[i];
    return row.value[i] + rise * (3 * t2 - 2 * t3) + row.slope[i] * (t3 - 2 * t2 + t) +
           row.slope[i + 1] * (t3 - t2);
  }

 private:
  static constexpr int kIntervals = 64;
  static constexpr double kReach = 6;
  struct Row {
    float scale = 0;
    std::array<float, kIntervals + 1> value, slope;
  };
  /// d/dc of (n+1) V / 2π = (n+1) C(n+1) sin^(n−1) / 2π.
  static double slope(uint32_t n, double c) {
    double wallis = n % 2 ? kPiD : 2;  // C(n+1)
    for (uint32_t m = n % 2 ? 2 : 3; m <= n + 1; m += 2) wallis *= (m - 1.) / m;
    return (n + 1) * wallis * std::pow((1 - c) * (1 + c), (n - 1) / 2.) / (2 * kPiD);
  }
  std::array<Row, kLobeLevels> rows_;
};

}  // namespace

int lobeLevel(float e) {
  if (!(e > 1)) return 0;
  int level = 0;
  while (level + 1 < kLobeLevels && static_cast<float>(lobeExponent(level)) < e) ++level;
  return level;
}

double clippedLobeIntegral(uint32_t n, double cosTilt) {
  const double c = std::min(std::abs(cosTilt), 1.);
  const double u = upperShare(n, c);
  return (kPiD + (cosTilt < 0 ? -u : u)) / (n + 1.);
}

float inverseClippedLobe(int level, float cosTilt) {
  static const LobeTable table;
  const uint32_t n = lobeExponent(level);
  if (n < LobeTable::kLeastExponent)
    return static_cast<float>(1 / clippedLobeIntegral(n, static_cast<double>(cosTilt)));
  return inverseWholeLobe(level) / table(level, cosTilt);
}

float lobePower(int level, const Vec3& axis, const Vec3& w) {
  // The cosine from the chord, which keeps its digits near the axis, where large powers need them.
  const double c = 1 - 0.5 * static_cast<double>(lengthSquared(w - axis));
  if (!(c > 0)) return 0;
  if (level == 0) return static_cast<float>(c);
  double power = level % 2 ? c * c : c * c * c;
  for (int k = lobeSquarings(level); k > 0; --k) power *= power;
  return static_cast<float>(power);
}

Vec3 sampleLobe(int level, const Vec3& axis, const Vec2& u) {
  // cos = (1 − u)^(1/(n+1)); in double precision 1 − cos has digits left where lobes are narrow.
  const double n = lobeExponent(level);
  const auto x = static_cast<float>(1 - std::exp(std::log(1 - static_cast<double>(u.x)) / (n + 1)));
  const float sine = std::sqrt(std::max(0.f, x * (2 - x)));
  const Frame frame = Frame::fromZ(axis);
  return normalize(frame.toWorld(sphericalDirection(sine, 1 - x, 2 * kPi * u.y)));
}

Vec3 sampleClippedLobe(int level, const Vec3& axis, const Vec3& n, const Vec2& u,
                       NumberSequence& more) {
  // At least half of the lobe is above: 64 draws below in a row do not happen.
  constexpr int kMaxDraws = 64;
  Vec3 w = sampleLobe(level, axis, u);
  for (int i = 1; i < kMaxDraws && !(dot(w, n) > 0); ++i) w = sampleLobe(level, axis, more.next2());
  return dot(w, n) > 0 ? w : axis;
}

}  // namespace lampyris
