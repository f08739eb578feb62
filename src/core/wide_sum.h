// SPDX-License-Identifier: Apache-2.0
/// Sums that do not depend on the order of their terms.
#pragma once

namespace lampyris {

/// A sum in two doubles (T. J. Dekker 1971, "A Floating-Point Technique for Extending the Available
/// Precision"; two-sum by D. Knuth, The Art of Computer Programming 2, §4.2.2). Exact, and so the
/// same in any order and grouping, as long as the terms' last bits and the largest partial sum are
/// no more than 2¹⁰⁵ apart; beyond, an addition is wrong by 2⁻¹⁰⁵ of the sum at most. Finite terms,
/// whose sum stays below 1e308.
struct WideSum {
  double high = 0;  ///< the sum, rounded to a double
  double low = 0;   ///< the rest

  void add(double term);
  WideSum& operator+=(const WideSum& other) { return add(other.high), add(other.low), *this; }
  bool operator==(const WideSum&) const = default;
};

}  // namespace lampyris
