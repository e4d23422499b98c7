// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/mapping/drawn_rooms.hpp"
#include <heel/mapping/likelihood_field.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace heel {
namespace {

using test::emptyRoom;

TEST(LikelihoodField, MeasuresToTheRimOfTheWall) {
  const LikelihoodField field(emptyRoom(4.0, 3.0));
  // The cell over (1.0, 0.30) has its middle at y = 0.325; the wall's rim is at 0.
  EXPECT_NEAR(field.distance_m({1.0, 0.31}), 0.325, 1e-6);
  EXPECT_NEAR(field.distance_m({3.91, 1.5}), 0.075, 1e-6);
  EXPECT_NEAR(field.distance_m({2.0, 1.51}), 1.475, 1e-6);
}

TEST(LikelihoodField, HasTheMixturesLogLikelihoodInClosedForm) {
  LikelihoodFieldParams params;
  params.hit_m = 0.1;
  params.hit_share = 0.7;
  params.random_over_m = 20.0;
  const LikelihoodField field(emptyRoom(4.0, 3.0), params);
  const double d = 0.075;
  const double hit = 0.7 * std::exp(-0.5 * d * d / 0.01) / (0.1 * std::sqrt(2.0 * test::kPi));
  EXPECT_NEAR(field.logLikelihood({1.0, 0.06}), std::log(hit + 0.3 / 20.0), 1e-5);
  EXPECT_NEAR(field.logLikelihood({1e6, -1e6}), field.logLikelihoodAt(params.far_m), 1e-5);
}

TEST(LikelihoodField, ScoresAllPosesAsOneByOne) {
  const LikelihoodField field(test::oddRoom());
  BeamEnds ends;
  for (int i = 0; i < 131; ++i) ends.add({0.03 * i, 1.5 - 0.04 * i});  // More than one block.
  const std::vector<float> x{1.0F, 4.0F, -3.0F}, y{1.0F, 3.0F, 40.0F}, yaw{0.0F, 2.0F, -1.0F};
  std::vector<float> c, s, sums(3);
  for (const float a : yaw) {
    c.push_back(std::cos(a));
    s.push_back(std::sin(a));
  }
  field.score(ends, 3, x.data(), y.data(), c.data(), s.data(), sums.data());
  for (std::size_t i = 0; i < 3; ++i) {
    const FloorPose pose{{x[i], y[i]}, yaw[i]};
    double sum = 0.0;
    for (std::size_t k = 0; k < ends.size(); ++k) {
      sum += field.logLikelihood(pose * Eigen::Vector2d(ends.x[k], ends.y[k]));
    }
    // A point on the rim of a cell may fall on either side of it.
    EXPECT_NEAR(sums[i], sum, 0.02 * std::abs(sum));
  }
}

TEST(LikelihoodField, CastsRaysAsFarAsAMarchInSmallSteps) {
  const OccupancyGrid room = test::oddRoom();
  const LikelihoodField field(room);
  for (const FloorPose& pose : {FloorPose{{1.0, 1.0}, 0.3}, FloorPose{{6.0, 4.0}, -2.0}}) {
    const LaserScan scan = test::scanOf(room, pose, 91, 6.2);
    int farther = 0;
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
      const double range = field.castRay(pose.position, pose.yaw_rad + scan.angle(i), 20.0);
      farther += range > scan.ranges_m[i] + 0.05 ? 1 : 0;
      // A ray that cuts a cell's corner for less than its step may miss it.
      if (std::abs(range - scan.ranges_m[i]) > 0.05) {
        const double near = field.distance_m(
            pose.position + std::min<double>(range, scan.ranges_m[i]) *
                                Eigen::Vector2d(std::cos(pose.yaw_rad + scan.angle(i)),
                                                std::sin(pose.yaw_rad + scan.angle(i))));
        EXPECT_LT(near, 0.05) << "beam " << i;
      }
    }
    EXPECT_LE(farther, 4) << "of 91";
  }
  EXPECT_EQ(field.castRay({-0.1, 1.0}, 0.0, 20.0), 0.0) << "in a wall";
  EXPECT_EQ(field.castRay({1.0, 1.0}, 0.0, 0.5), 0.5) << "nothing so near";
}

TEST(LikelihoodField, HasNoSurfaceDeepInsideAThickThing) {
  OccupancyGrid grid = emptyRoom(6.0, 6.0);
  test::drawBlock(grid, 2.0, 2.0, 4.0, 4.0);
  const LikelihoodField field(grid);
  EXPECT_GT(field.distance_m({3.0, 3.0}), 0.9);
  EXPECT_LT(field.logLikelihood({3.0, 3.0}), field.logLikelihood({2.0, 3.0}) - 3.0);
}

TEST(LikelihoodField, APlaceThatIsNoNumberIsTheCorner) {
  const LikelihoodField field(emptyRoom(2.0, 2.0));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double corner = field.logLikelihood({-9.0, -9.0});
  EXPECT_EQ(field.logLikelihood({nan, nan}), corner);
  EXPECT_EQ(field.distance_m({nan, nan}), field.distance_m({-9.0, -9.0}));
  BeamEnds ends;
  ends.x = {std::numeric_limits<float>::quiet_NaN()};
  ends.y = {0.5F};
  const float zero = 0.0F, one = 1.0F;
  float sum = 0.0F;
  field.score(ends, 1, &one, &one, &one, &zero, &sum);
  EXPECT_TRUE(std::isfinite(sum));
}

TEST(LikelihoodField, RejectsWhatMakesNoSense) {
  EXPECT_THROW(LikelihoodField(OccupancyGrid{}), std::invalid_argument);
  LikelihoodFieldParams params;
  params.hit_share = 1.0;
  EXPECT_THROW(LikelihoodField(emptyRoom(2.0, 2.0), params), std::invalid_argument);
  params = {};
  params.hit_m = 0.0;
  EXPECT_THROW(LikelihoodField(emptyRoom(2.0, 2.0), params), std::invalid_argument);
}

}  // namespace
}  // namespace heel
