// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The tracker allocates nothing once it is warm.
#include "tests/support/allocation_count.hpp"
#include "tracking/target.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace heel {
namespace {

TEST(Allocation, IsSeenByThisTest) {
  const long before = test::allocations();
  const std::vector<int> control(10);
  EXPECT_EQ(test::allocations(), before + 1);
}

TEST(Allocation, TrackingMakesNoneOnceWarm) {
  TargetTracker target({}, {}, allOf({tooClose(0.3), insideBounds({-9, -9}, {9, 9})}));
  std::vector<Observation> all;
  long before = 0;
  for (int k = 0; k < 600; ++k) {
    all.clear();
    for (int person = 0; person < 6; ++person) {
      // People come and go, so that tracks are born, coast, end, and are searched for.
      if ((k / 20 + person) % 4 != 0) {
        all.push_back({{2.0 + std::sin(0.05 * k + person), 1.0 * person}, 10.0, 0.15 * person});
      }
    }
    if (k == 300) {
      before = test::allocations();
    }
    target.step(0.1 * k, all);
  }
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace
}  // namespace heel
