// SPDX-License-Identifier: Apache-2.0
/// Newton's method, kept within an interval by bisection.
#pragma once

#include <cmath>

namespace lampyris {

/// The t in [a, b] with f(t).first = target, where f(t).second is the derivative, for a function
/// that increases from below the target at `a` to above it at `b`. To a few roundings of t.
template <class F, class T>
T solveIncreasing(const F& f, T a, T b, T target) {
  const T tolerance = (b - a) * T(1e-7);
  T t = (a + b) / 2;
  for (int i = 0; i < 60; ++i) {
    const auto [value, slope] = f(t);
    if (value == target) break;
    (value < target ? a : b) = t;
    const T step = (target - value) / slope;
    T next = t + step;
    if (!(next > a && next < b)) next = (a + b) / 2;
    const T moved = std::abs(next - t);
    t = next;
    if (moved < tolerance) break;
  }
  return t;
}

}  // namespace lampyris
