// SPDX-License-Identifier: Apache-2.0
#include "core/wide_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace lampyris {

namespace {

/// Products of two floats, of either sign, over `octaves` powers of two.
std::vector<double> terms(size_t count, int octaves) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> mantissa(-1, 1);
  std::uniform_int_distribution<int> exponent(-octaves, 0);
  std::vector<double> all(count);
  for (double& t : all)
    t = std::ldexp(static_cast<double>(mantissa(random)) * static_cast<double>(mantissa(random)),
                   exponent(random));
  return all;
}

WideSum sumOf(const std::vector<double>& all, size_t begin, size_t end) {
  WideSum sum;
  for (size_t i = begin; i < end; ++i) sum.add(all[i]);
  return sum;
}

TEST(WideSum, KeepsWhatADoubleLoses) {
  WideSum sum;
  for (const double t : {0x1p100, 1., -0x1p-4, -0x1p100, 0x1p-60}) sum.add(t);
  EXPECT_EQ(sum.high, 1 - 0x1p-4);
  EXPECT_EQ(sum.low, 0x1p-60);
}

TEST(WideSum, NeitherOrderNorGroupingChangesABit) {
  std::vector<double> all = terms(5000, 40);
  const WideSum inOrder = sumOf(all, 0, all.size());
  std::mt19937 random(3);
  for (int round = 0; round < 50; ++round) {
    std::shuffle(all.begin(), all.end(), random);
    EXPECT_EQ(sumOf(all, 0, all.size()), inOrder);
    const size_t a = random() % all.size(), b = a + random() % (all.size() - a);
    WideSum grouped = sumOf(all, b, all.size());
    grouped += sumOf(all, 0, a);
    grouped += sumOf(all, a, b);
    EXPECT_EQ(grouped, inOrder);
  }
}

/// Where terms are further apart than the sum is exact, its value is still that of the order.
TEST(WideSum, TheRoundedSumIsTheSameOverAnyRange) {
  std::vector<double> all = terms(5000, 600);
  const double inOrder = sumOf(all, 0, all.size()).high;
  std::reverse(all.begin(), all.end());
  EXPECT_EQ(sumOf(all, 0, all.size()).high, inOrder);
}

}  // namespace
}  // namespace lampyris
