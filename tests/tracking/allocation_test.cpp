// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The tracker allocates nothing once it is warm.
#include "tests/support/allocation_count.hpp"
#include "tests/tracking/looks.hpp"
#include <heel/tracking/target.hpp>

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

// Of `operator new`: Eigen's own memory is not counted.
TEST(Allocation, TrackingMakesNoneOnceWarm) {
  std::vector<Eigen::ArrayXXf> clothes;
  for (int person = 0; person < 6; ++person) {
    clothes.push_back(test::clothes(person, (person + 1) % test::kColors, 0.9F));
  }
  Viewpoint viewpoint;
  viewpoint.sight_of = [](const Eigen::Vector2d&) { return Sight::kFree; };
  TargetTracker target({}, {}, allOf({tooClose(0.3), insideBounds({-9, -9}, {9, 9})}),
                       test::looksOf(clothes[0]));
  std::vector<Observation> all;
  long before = 0;
  int followed = 0;
  for (int k = 0; k < 1600; ++k) {
    all.clear();
    for (int person = 0; person < 6; ++person) {
      // People come and go, so that tracks are born, coast, end, and are searched for.
      if ((k / 20 + person) % 4 != 0) {
        all.push_back(test::seen(2.0 + std::sin(0.05 * k + person), 1.2 * person,
                                 &clothes[static_cast<std::size_t>(person)]));
      }
    }
    if (k == 800) {
      before = test::allocations();
    }
    target.step(0.1 * k, all, viewpoint);
    followed += target.estimate().hasPlace() ? 1 : 0;
  }
  EXPECT_EQ(test::allocations(), before);
  EXPECT_GT(followed, 400);
}

}  // namespace
}  // namespace heel
