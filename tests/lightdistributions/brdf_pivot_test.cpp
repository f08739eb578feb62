// SPDX-License-Identifier: Apache-2.0
#include "lightdistributions/brdf_pivot.h"

#include <gtest/gtest.h>

#include <numeric>

#include "core/sampling.h"
#include "lightdistributions/brdf_pivot_lanes.h"
#include "lightdistributions/brdf_pivot_table.h"
#include "materials/trowbridge_reitz.h"
#include "support/statistics.h"

namespace lampyris::test {
namespace {

constexpr double kPiD = 3.14159265358979323846;

Vec3 direction(double theta, double phi) {
  return {static_cast<float>(std::sin(theta) * std::cos(phi)),
          static_cast<float>(std::sin(theta) * std::sin(phi)), static_cast<float>(std::cos(theta))};
}
DirectionCap capOf(const Vec3& axis, double halfAngle) {
  return {axis, static_cast<float>(sqr(std::sin(halfAngle)))};
}

/// The definition: uniform density through the Möbius transform with pivot p, 1/sr.
double pivotDensity(const glm::dvec3& pivot, const glm::dvec3& w) {
  const double p2 = glm::dot(pivot, pivot);
  const glm::dvec3 d = w - pivot;
  return sqr((1 - p2) / glm::dot(d, d)) / (4 * kPiD);
}

/// ∫ over the cap's part above the horizon z = 0, by midpoints on rings of the cap.
template <class F>
double integrateCap(const Vec3& axis, double halfAngle, int n, const F& f) {
  const Frame frame = Frame::fromZ(axis);
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double v = (i + 0.5) / n * 2 * sqr(std::sin(0.5 * halfAngle)), z = 1 - v;
    const double s = std::sqrt(v * (2 - v));
    for (int j = 0; j < n; ++j) {
      const double phi = 2 * kPiD * (j + 0.5) / n;
      const glm::dvec3 w = s * std::cos(phi) * glm::dvec3(frame.x) +
                           s * std::sin(phi) * glm::dvec3(frame.y) + z * glm::dvec3(frame.z);
      if (w.z > 0) sum += f(w);
    }
  }
  return sum * 4 * kPiD * sqr(std::sin(0.5 * halfAngle)) / (n * n);
}

TEST(BrdfPivot, DensityIsTheMoebiusTransforms) {
  for (const double k : {1., 1.3, 4., 30., 1000.}) {
    const Vec3 axis = direction(0.6, 0.3);
    const PivotLobe lobe(axis, static_cast<float>(1 / k), axis, 1);
    const glm::dvec3 pivot = (k - 1) / (k + 1) * glm::normalize(glm::dvec3(axis));
    // The lobe is normalised over the hemisphere about its axis.
    const double above = sqr(k) / (1 + sqr(k));
    for (int i = 0; i < 50; ++i) {
      const Vec3 w = normalize(axis + static_cast<float>(i) * 0.02f * direction(2.1, i));
      if (dot(w, axis) <= 0) continue;
      const double expected = pivotDensity(pivot, glm::normalize(glm::dvec3(w))) / above;
      const double tolerance = 1e-3;  // of the direction's rounding for k = 1000
      EXPECT_NEAR(static_cast<double>(lobe.density(w)), expected, tolerance * expected) << k;
    }
  }
}

TEST(BrdfPivot, CapIntegralsAreExact) {
  // Caps above, across and below the horizon, about and beside the lobe.
  for (const double width : {1., 0.15})
    for (const double tilt : {0., 0.7, 1.4}) {
      const Vec3 axis = direction(tilt, 0);
      const double k = 1 / static_cast<double>(static_cast<float>(width));
      const PivotLobe lobe(axis, static_cast<float>(width), {0, 0, 1}, 1);
      const glm::dvec3 pivot = (k - 1) / (k + 1) * glm::dvec3(axis);
      const auto density = [&](const glm::dvec3& w) { return pivotDensity(pivot, w); };
      const double hemisphere = integrateCap({0, 0, 1}, kPiD / 2, 400, density);
      for (const double capTilt : {0.5, 1.2, 1.5, 1.7})
        for (const double phi : {0., 2.5})
          for (const double half : {0.03, 0.8, 1.5}) {
            const Vec3 centre = direction(capTilt, phi);
            const DirectionCap cap = capOf(centre, half);
            const double expected = integrateCap(centre, half, 250, density) / hemisphere;
            const double got = static_cast<double>(lobe.mean(cap) * cap.solidAngle());
            EXPECT_NEAR(got, expected, 0.005 * expected + 2e-4 * half * half)
                << width << " " << tilt << " " << capTilt << " " << phi << " " << half;
          }
    }
}

/// Eight caps at once, against the exact integral over each: equal where the horizon cuts nothing,
/// and elsewhere within a quarter of the lobe, in the mean square 2 % of it.
TEST(BrdfPivot, LanesAreNearTheExactIntegrals) {
  constexpr size_t kLanes = Float8::size();
  std::vector<double> squares;
  for (uint32_t i = 0; i < 4000; ++i) {
    const Vec3 axis = sampleUniformSphere({0.5f * uniform(3, i, 0), uniform(3, i, 1)});
    const PivotLobe lobe(axis, std::pow(uniform(3, i, 2), 3.f) * 0.999f + 1e-3f, {0, 0, 1}, 1);
    std::array<DirectionCap, kLanes> caps;
    for (uint32_t k = 0; k < kLanes; ++k) {
      const float angle = std::pow(uniform(4, i, 4 * k), 4.f) * 1.5f;
      caps[k] = capOf(sampleUniformSphere({uniform(4, i, 4 * k + 1), uniform(4, i, 4 * k + 2)}),
                      static_cast<double>(angle));
    }
    const auto lanes = [&](const auto& value) {
      return Float8([&](auto k) { return value(caps[k]); });
    };
    const CapLanes all{lanes([](const auto& c) { return c.axis.x; }),
                       lanes([](const auto& c) { return c.axis.y; }),
                       lanes([](const auto& c) { return c.axis.z; }),
                       lanes([](const auto& c) { return c.sine; }),
                       lanes([](const auto& c) { return c.cosine(); }),
                       lanes([](const auto& c) { return c.versine; })};
    Float8 widest = 0;
    const Float8 got = PivotLobeLanes::mean(lobe, all, widest);
    for (size_t k = 0; k < kLanes; ++k) {
      const float exact = lobe.mean(caps[k]), height = caps[k].axis.z;
      if (height >= caps[k].sine) {
        EXPECT_NEAR(got[k], exact, 1e-3f * exact);
      } else if (height <= -caps[k].sine) {
        EXPECT_EQ(got[k], 0);
      } else {
        const float error = (got[k] - exact) * caps[k].solidAngle();
        EXPECT_LT(std::abs(error), 0.25f);
        squares.push_back(static_cast<double>(sqr(error)));
      }
    }
  }
  const double sum = std::accumulate(squares.begin(), squares.end(), 0.);
  EXPECT_LT(std::sqrt(sum / static_cast<double>(squares.size())), 0.02);
}

TEST(BrdfPivot, CosineIntegralsAreExact) {
  for (const double capTilt : {0., 0.5, 1.2, 1.5, 1.57, 1.7, 2.2})
    for (const double half : {1e-4, 0.01, 0.03, 0.2, 0.8, 1.5}) {
      const Vec3 centre = direction(capTilt, 1);
      const DirectionCap cap = capOf(centre, half);
      const double expected =
          integrateCap(centre, half, 400, [](const glm::dvec3& w) { return w.z / kPiD; }) /
          (4 * kPiD * sqr(std::sin(0.5 * half)));
      EXPECT_NEAR(static_cast<double>(meanCosine(cap, centre.z)), expected,
                  2e-3 * expected + 1e-4 * half)
          << capTilt << " " << half;
    }
}

TEST(BrdfPivot, NarrowLobesKeepTheirDigits) {
  // At normal incidence ∫ over a cap about the axis is t² / (α² + t²), t = tan(θ/2), over
  // that of the hemisphere.
  for (const double alpha : {1e-3, 0.01, 0.3})
    for (const double t : {1e-6, 1e-4, 1e-3, 0.01, 0.5}) {
      const PivotLobe lobe({0, 0, 1}, static_cast<float>(alpha), {0, 0, 1}, 1);
      const DirectionCap cap = capOf({0, 0, 1}, 2 * std::atan(t));
      const double expected = t * t / (sqr(alpha) + t * t) * (1 + sqr(alpha));
      EXPECT_NEAR(static_cast<double>(lobe.mean(cap) * cap.solidAngle()), expected,
                  2e-5 * expected);
    }
}

TEST(BrdfPivot, AnyCapGivesAShare) {
  for (uint64_t i = 0; i < 20000; ++i) {
    const auto u = [i](uint32_t d) { return uniform(3, i, d); };
    Vec3 axis = sampleUniformSphere({u(0), u(1)});
    axis.z = std::abs(axis.z);
    const PivotLobe lobe(axis, std::max(5e-4f, sqr(sqr(u(2)))), {0, 0, 1}, 1);
    Vec3 centre = sampleUniformSphere({u(3), u(4)});
    if (i % 3 == 0) centre = normalize(axis + std::pow(u(5), 8.f) * centre);
    const DirectionCap cap(centre, std::pow(u(6), 12.f));
    const float share = lobe.mean(cap) * cap.solidAngle();
    ASSERT_TRUE(share >= 0 && share <= 1.001f) << i << " " << share;
    const float cosine = meanCosine(cap, centre.z) * cap.solidAngle();
    ASSERT_TRUE(cosine >= 0 && cosine <= 1.001f) << i << " " << cosine;
  }
}

/// ∫ BRDF × cosine of white facets over a cap, by drawing visible facets: the mean of the weights
/// of the draws that fall into it.
class FacetDraws {
 public:
  FacetDraws(float alpha, const Vec3& wo) {
    const TrowbridgeReitz facets(alpha, alpha);
    for (int i = 0; i < kDraws; ++i) {
      const Vec2 u((static_cast<float>(i) + 0.5f) / kDraws,
                   std::fmod(static_cast<float>(i) * 0.61803399f, 1.f));
      const Vec3 m = facets.sampleVisible(wo, u), w = 2 * dot(wo, m) * m - wo;
      if (!(w.z > 0)) continue;
      // f cos θ over the density of visible normals is G / G1.
      directions_.push_back(w);
      weights_.push_back(facets.visibilityOver4Cosines(wo, w) * w.z * 4 /
                         facets.visibilityOverCosine(wo));
    }
  }
  double within(const Vec3& axis, double halfAngle) const {
    double sum = 0;
    const auto least = static_cast<float>(2 * sqr(std::sin(halfAngle / 2)));
    for (size_t i = 0; i < directions_.size(); ++i)
      if (0.5f * lengthSquared(directions_[i] - axis) < least)
        sum += static_cast<double>(weights_[i]);
    return sum / kDraws;
  }

 private:
  static constexpr int kDraws = 10000;
  std::vector<Vec3> directions_;
  std::vector<float> weights_;
};

TEST(BrdfPivot, FitsFacetsWithinTheStatedError) {
  // Half of ∫ |lobe − fit| bounds the error of the integral over any cap. Between nodes too, with
  // a little more for interpolation.
  for (const float alpha : {0.001f, 0.004f, 0.02f, 0.07f, 0.25f, 0.6f, 1.3f})
    for (const float degreesView : {0.f, 10.f, 35.f, 55.f, 70.f, 82.f, 88.f}) {
      const float view = radians(degreesView);
      const Vec3 wo(std::sin(view), 0, std::cos(view));
      const PivotFit fit = PivotTable::lookup(alpha, view);
      const PivotLobe lobe = reflectionLobe(wo, {0, 0, 1}, alpha, 1);
      const FacetDraws draws(alpha, wo);
      EXPECT_NEAR(static_cast<double>(lobe.integral()), draws.within({0, 0, 1}, kPiD / 2), 0.02)
          << alpha << " " << degreesView;
      const double scale = 2 * static_cast<double>(PivotTable::meanWidth(alpha, wo.z));
      for (const double away : {0., 0.7, 2., 5.})
        for (const double around : {0., 1.5, 3.})
          for (const double radius : {0.3, 1., 4.}) {
            const Frame mirror = Frame::fromZ({-wo.x, 0, wo.z});
            const Vec3 axis = mirror.toWorld(direction(std::min(away * scale, 1.5), around));
            const double half = std::min(radius * scale, 1.5);
            const DirectionCap cap = capOf(axis, half);
            const double got = static_cast<double>(lobe.mean(cap) * cap.solidAngle());
            const double bound = 0.5 * static_cast<double>(fit.error * fit.albedo) + 0.02;
            EXPECT_NEAR(got, draws.within(axis, half), bound)
                << alpha << " " << degreesView << " " << away << " " << around << " " << radius;
          }
    }
}

TEST(BrdfPivot, FitsAreExactAtNormalIncidence) {
  // Without masking: the distribution of mirrored directions is a pivot transformed one, width α.
  for (size_t i = 0; i < 6; ++i) EXPECT_LT(PivotTable::data()[i][0].error, 0.01f);
}

}  // namespace
}  // namespace lampyris::test
