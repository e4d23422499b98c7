// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/path.hpp>

#include <gtest/gtest.h>

#include <stdexcept>

namespace heel {
namespace {

TEST(Path, IsAsLongAsItsPieces) {
  EXPECT_DOUBLE_EQ(pathLength({{0, 0}, {3, 4}, {3, 6}}), 7.0);
  EXPECT_DOUBLE_EQ(pathLength({}), 0.0);
}

TEST(Path, ResampledKeepsItsWayPointsAndHasShortSteps) {
  const FloorPath fine = resample({{0, 0}, {1, 0}, {1, 0.25}}, 0.3);
  ASSERT_EQ(fine.size(), 6U);
  EXPECT_TRUE(fine[1].isApprox(Eigen::Vector2d(0.25, 0)));
  EXPECT_EQ(fine[4], Eigen::Vector2d(1, 0));
  EXPECT_EQ(fine[5], Eigen::Vector2d(1, 0.25));
  EXPECT_NEAR(pathLength(fine), 1.25, 1e-12);
}

TEST(Path, CannotBeResampledByNoStep) {
  EXPECT_THROW(resample({{0, 0}, {1, 0}}, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace heel
