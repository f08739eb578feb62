// SPDX-License-Identifier: Apache-2.0
/// Statistical tests. A test states its false-alarm rate; the default is 1e-9 a check, so that a
/// run of a thousand checks fails by chance once in a million.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/vector.h"

namespace lampyris::test {

inline constexpr double kFalseAlarm = 1e-9;

/// P(χ² with `dof` degrees of freedom ≥ statistic).
double chiSquarePValue(double statistic, int dof);

/// Pearson's χ² test of observed counts against expected ones. Cells with an expected count below
/// 5 are pooled. Returns "" if it passes, else what failed.
std::string chiSquareTest(const std::vector<double>& observed, const std::vector<double>& expected,
                          double falseAlarm = kFalseAlarm);

/// χ² test that `sample` draws directions with `pdf` (by solid angle), on a grid of cos θ × φ over
/// the whole sphere. `sample` returns false where it draws nothing (such draws count as a cell of
/// their own, of probability 1 − ∫pdf). The pdf is integrated over each cell by a quadrature with
/// `subdivisions`² points.
struct DirectionTest {
  std::function<bool(const Vec2& u, float uc, Vec3& w)> sample;
  std::function<double(const Vec3& w)> pdf;
  int thetaCells = 20, phiCells = 40, subdivisions = 12;
  int samples = 200'000;
  uint64_t seed = 1;
};
std::string directionChiSquareTest(const DirectionTest& test, double falseAlarm = kFalseAlarm);

/// t test of a mean: "" if |mean − expected| is within what the standard error allows (plus
/// `slack`, for errors of quadrature). The values are taken for normal.
std::string meanTest(const std::vector<double>& values, double expected, double slack = 0,
                     double falseAlarm = kFalseAlarm);

/// Uniform variates for tests: a pure function of (seed, index, dimension).
float uniform(uint64_t seed, uint64_t index, uint32_t dimension);

}  // namespace lampyris::test
