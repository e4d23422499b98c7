// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/pictures/trails.hpp>

#include <gmock/gmock.h>

namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(Trails, KeepTheLastPlacesOfEachTrack) {
  heel::Trails trails(1.0);
  for (int k = 0; k < 5; ++k) trails.add(7, 0.5 * k, {k, 0.0});
  trails.add(8, 0.0, {9.0, 9.0});
  trails.forget(2.0);
  EXPECT_THAT(trails.of(7),
              ElementsAre(Eigen::Vector2d(2, 0), Eigen::Vector2d(3, 0), Eigen::Vector2d(4, 0)));
  EXPECT_THAT(trails.of(8), IsEmpty());
  EXPECT_THAT(trails.of(9), IsEmpty());
}

}  // namespace
