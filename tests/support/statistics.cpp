// SPDX-License-Identifier: Apache-2.0
#include "support/statistics.h"

#include <fmt/format.h>

#include <cmath>

#include "core/frame.h"
#include "core/hash.h"

namespace lampyris::test {

namespace {

/// The regularised upper incomplete gamma function Q(a, x), by its series or continued fraction
/// (Abramowitz and Stegun 6.5.29, 6.5.31).
double upperGamma(double a, double x) {
  if (x <= 0) return 1;
  const double front = std::exp(-x + a * std::log(x) - std::lgamma(a));
  if (x < a + 1) {
    double term = 1 / a, sum = term;
    for (int n = 1; n < 10000 && term > sum * 1e-16; ++n) sum += term *= x / (a + n);
    return 1 - front * sum;
  }
  // Evaluated from the tail: robust, and tails are what tests look at.
  double f = 0;
  for (int n = 2000; n >= 1; --n) f = n * (n - a) / (x + 2 * n + 1 - a - f);
  return front / (x + 1 - a - f);
}

/// P(|T| ≥ t) for Student's T, by a normal variable (Wallace 1959, "Bounds on normal approximations
/// to Student's and the chi-square distributions"): for t up to 10, no more than 14 % off from 7
/// degrees of freedom on.
double studentPValue(double t, double dof) {
  const double z = (8 * dof + 1) / (8 * dof + 3) * std::sqrt(dof * std::log1p(t * t / dof));
  return std::erfc(z / std::sqrt(2.));
}

}  // namespace

double chiSquarePValue(double statistic, int dof) { return upperGamma(dof / 2., statistic / 2); }

std::string chiSquareTest(const std::vector<double>& observed, const std::vector<double>& expected,
                          double falseAlarm) {
  double statistic = 0, pooledObserved = 0, pooledExpected = 0;
  int cells = 0;
  const auto add = [&](double o, double e) {
    statistic += (o - e) * (o - e) / e;
    ++cells;
  };
  for (size_t i = 0; i < observed.size(); ++i) {
    if (expected[i] <= 0 && observed[i] > 0)
      return fmt::format("cell {}: {} draws where none can be", i, observed[i]);
    if (expected[i] >= 5) {
      add(observed[i], expected[i]);
    } else {
      pooledObserved += observed[i];
      pooledExpected += expected[i];
    }
  }
  if (pooledExpected >= 5) {
    add(pooledObserved, pooledExpected);
  } else if (pooledObserved > 5 + 40 * std::sqrt(pooledExpected + 1)) {
    return fmt::format("{} draws in cells that expect {}", pooledObserved, pooledExpected);
  }
  if (cells < 2) return "";
  const double p = chiSquarePValue(statistic, cells - 1);
  return p >= falseAlarm ? "" : fmt::format("chi2 = {} with {} cells: p = {}", statistic, cells, p);
}

std::string directionChiSquareTest(const DirectionTest& t, double falseAlarm) {
  const size_t cells = static_cast<size_t>(t.thetaCells) * static_cast<size_t>(t.phiCells);
  std::vector<double> observed(cells + 1), expected(cells + 1);
  for (int i = 0; i < t.samples; ++i) {
    const auto n = static_cast<uint64_t>(i);
    Vec3 w;
    if (!t.sample({uniform(t.seed, n, 0), uniform(t.seed, n, 1)}, uniform(t.seed, n, 2), w)) {
      ++observed[cells];
      continue;
    }
    const int y = std::min(static_cast<int>((w.z + 1) / 2 * static_cast<float>(t.thetaCells)),
                           t.thetaCells - 1);
    const int x =
        std::min(static_cast<int>(sphericalPhi(w) / (2 * kPi) * static_cast<float>(t.phiCells)),
                 t.phiCells - 1);
    ++observed[static_cast<size_t>(y * t.phiCells + x)];
  }
  double total = 0;
  const int s = t.subdivisions;
  for (int y = 0; y < t.thetaCells; ++y) {
    for (int x = 0; x < t.phiCells; ++x) {
      double sum = 0;
      for (int j = 0; j < s; ++j) {
        for (int i = 0; i < s; ++i) {
          const double z = -1 + 2 * (y + (j + 0.5) / s) / t.thetaCells;
          const double phi = 2 * M_PI * (x + (i + 0.5) / s) / t.phiCells;
          sum += t.pdf(sphericalDirection(static_cast<float>(std::sqrt(std::max(0., 1 - z * z))),
                                          static_cast<float>(z), static_cast<float>(phi)));
        }
      }
      const double probability = sum * 4 * M_PI / (t.thetaCells * t.phiCells * s * s);
      expected[static_cast<size_t>(y * t.phiCells + x)] = probability * t.samples;
      total += probability;
    }
  }
  if (total > 1.01) return fmt::format("the pdf integrates to {}", total);
  expected[cells] = std::max(0., 1 - total) * t.samples;
  return chiSquareTest(observed, expected, falseAlarm);
}

std::string meanTest(const std::vector<double>& values, double expected, double slack,
                     double falseAlarm) {
  double mean = 0, m2 = 0;
  double n = 0;
  for (const double v : values) {
    n += 1;
    const double d = v - mean;
    mean += d / n;
    m2 += d * (v - mean);
  }
  const double error = std::sqrt(m2 / (n * (n - 1)));
  const double excess = std::abs(mean - expected) - slack;
  if (excess <= 0) return "";
  const double p = studentPValue(excess / error, n - 1);
  return p >= falseAlarm
             ? ""
             : fmt::format("mean {} ± {}, expected {} (p = {})", mean, error, expected, p);
}

float uniform(uint64_t seed, uint64_t index, uint32_t dimension) {
  return toUnitFloat(hashCombine(hashCombine(seed, index), dimension));
}

}  // namespace lampyris::test
