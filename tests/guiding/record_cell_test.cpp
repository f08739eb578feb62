// SPDX-License-Identifier: Apache-2.0
#include "guiding/record_cell.h"

#include <gtest/gtest.h>

namespace lampyris::test {

namespace {

RecordCell cellThatTried(int tries, int found) {
  RecordCell cell(8);
  for (int i = 0; i < tries; ++i) {
    GuideSample s;
    s.n = s.wi = Vec3(0, 0, 1);
    s.radiance = s.pdf = 1;
    s.lightTried = true;
    s.lightFound = i * found % tries < found;  // evenly: what is long ago has faded
    cell.learn(s, true);
  }
  return cell;
}

TEST(RecordCell, LightIsWorthTryingAsOftenAsItArrives) {
  EXPECT_EQ(RecordCell(8).lightWorth(), 1);
  EXPECT_EQ(cellThatTried(10, 0).lightWorth(), 1) << "few tries say nothing";
  EXPECT_NEAR(cellThatTried(1000, 0).lightWorth(), 0.1, 1e-12) << "never given up";
  EXPECT_NEAR(cellThatTried(1000, 100).lightWorth(), 0.4, 0.03);
  EXPECT_EQ(cellThatTried(1000, 500).lightWorth(), 1);
  EXPECT_EQ(RecordCell(cellThatTried(1000, 0), 0.01).lightWorth(), 1) << "a part knows less";
}

}  // namespace

}  // namespace lampyris::test
