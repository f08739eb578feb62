// SPDX-License-Identifier: Apache-2.0
#include "core/wide_sum.h"

namespace lampyris {

/// Not inline: where the term is a product, the compiler would fuse it into some of the additions
/// and not into others.
void WideSum::add(double term) {
  const double sum = high + term, part = sum - high;
  const double rest = (high - (sum - part)) + (term - part) + low;
  high = sum + rest;
  low = rest - (high - sum);
}

}  // namespace lampyris
