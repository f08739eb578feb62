// SPDX-License-Identifier: Apache-2.0
#include "film/axis_table.h"

#include <array>
#include <cmath>
#include <vector>

#include "core/error.h"

namespace lampyris {

namespace {
struct Node {
  double x, weight;
};
// Gauss–Legendre quadrature with 5 points on [−1, 1] (Abramowitz and Stegun, table 25.4).
constexpr std::array<Node, 5> kGauss = {{{-0.906179845938664, 0.236926885056189},
                                         {-0.538469310105683, 0.478628670499366},
                                         {0., 0.568888888888889},
                                         {0.538469310105683, 0.478628670499366},
                                         {0.906179845938664, 0.236926885056189}}};
// No cell is drawn less often than this fraction of the average: where f ends in small values the
// float CDF would otherwise round their probability to 0 and lose them.
constexpr double kDefensive = 1e-4;
// Below this ratio of ∫f to ∫|f| the weights would be nothing but noise.
constexpr double kLeastMass = 1e-3;
}  // namespace

AxisTable::AxisTable(const std::function<double(double)>& f, double radius, size_t cells)
    : radius_(static_cast<float>(radius)) {
  const double step = 2 * radius / static_cast<double>(cells);
  std::vector<double> mass(cells);
  double integral = 0, absolute = 0;
  for (size_t i = 0; i < cells; ++i) {
    const double centre = -radius + (static_cast<double>(i) + 0.5) * step;
    for (const Node& node : kGauss) {
      const double v = f(centre + node.x * step / 2) * node.weight * step / 2;
      integral += v;
      mass[i] += std::abs(v);
    }
    absolute += mass[i];
  }
  if (!(integral > kLeastMass * absolute) || !std::isfinite(absolute))
    throw SceneError("the filter's integral is not positive; choose other parameters");
  const double mean = absolute / static_cast<double>(cells);
  std::vector<float> values(cells);
  for (size_t i = 0; i < cells; ++i)
    values[i] = static_cast<float>(std::max(mass[i] / mean, kDefensive));
  density_ = Distribution1D(values);
  factor_ = 2 * radius / integral;
}

}  // namespace lampyris
