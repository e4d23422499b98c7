// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/allocation_count.hpp"
#include <heel/apps/follower/wall_gate.hpp>
#include <heel/mapping/wall_map_builder.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

namespace heel {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr auto kAccepted = GateVerdict::kAccepted;
constexpr auto kInside = GateVerdict::kInsideWall;
constexpr auto kBehind = GateVerdict::kBehindWall;

// A wall of 0.2 m along y from x = 3.0 with a doorway of 1 m; the camera looks along x from (0, 0).
//
//    y  3 +----------+   A table, 0.75 m high, stands at (1.5, -2).
//         |          |
//       1 | C        |   (doorway from y = -0.5 to 0.5)
//       0 | camera
//         |          |
//      -3 +----------+
//         0          3   x
std::shared_ptr<const WallMap> rooms() {
  WallMapBuilder builder;
  builder.addFreeFloor({-1.0, -3.0}, {7.0, 3.0});
  builder.add(WallBox{{3.1, -1.75}, 0.0, {0.2, 2.5}, {0.0, 2.5}});
  builder.add(WallBox{{3.1, 1.75}, 0.0, {0.2, 2.5}, {0.0, 2.5}});
  builder.add(WallBox{{3.1, 0.0}, 0.0, {0.2, 1.0}, {2.1, 2.5}});
  builder.add(WallBox{{1.5, -2.0}, 0.0, {0.8, 0.8}, {0.0, 0.75}});
  return std::make_shared<const WallMap>(builder.build());
}

class WallGate : public testing::Test {
 protected:
  GateVerdict at(const Vector2d& place, const Matrix2d& covariance_m2 = Matrix2d::Zero()) const {
    Observation seen;
    seen.position_m = place;
    const double sigma_m = depth_error_pm_ * (place - eye_).squaredNorm();
    const Vector2d along = (place - eye_).normalized() * sigma_m;
    seen.covariance_m2 = along * along.transpose();
    return wallGate(rooms(), params_)(seen, {eye_, covariance_m2});
  }
  WallGateParams params_;
  double depth_error_pm_ = 0.0;
  Vector2d eye_ = Vector2d::Zero();
};

TEST_F(WallGate, KeepsWhatIsInFrontOfAWall) {
  EXPECT_EQ(at({2.0, 1.5}), kAccepted);
  EXPECT_EQ(at({2.0, -1.5}), kAccepted);
  EXPECT_EQ(at({0.5, 0.0}), kAccepted);
  EXPECT_EQ(at({2.7, 1.5}), kAccepted) << "0.3 m before the wall";
}

TEST_F(WallGate, RefusesWhatIsBehindAWall) {
  EXPECT_EQ(at({5.0, 2.5}), kBehind);
  EXPECT_EQ(at({5.0, -1.5}), kBehind);
  EXPECT_EQ(at({3.6, 1.5}), kBehind) << "just behind";
  eye_ = {6.0, 2.0};
  EXPECT_EQ(at({1.0, 2.0}), kBehind) << "from the other side";
}

TEST_F(WallGate, RefusesWhatIsInsideAWallOrAtIt) {
  EXPECT_EQ(at({3.1, 1.5}), kInside);
  EXPECT_EQ(at({2.95, 1.5}), kInside) << "a poster, 5 cm before the wall";
  EXPECT_EQ(at({3.1, 0.6}), kInside) << "in the door's post";
  eye_ = {6.0, 1.5};
  EXPECT_EQ(at({3.3, 1.5}), kInside) << "a coat on its other side";
}

TEST_F(WallGate, SeesThroughADoorway) {
  EXPECT_EQ(at({5.0, 0.0}), kAccepted);
  EXPECT_EQ(at({3.1, 0.0}), kAccepted) << "in the doorway itself";
  EXPECT_EQ(at({3.1, 0.3}), kAccepted) << "near its post";
  EXPECT_EQ(at({3.1, 0.4}), kInside) << "nobody's middle is so near to a post";
  EXPECT_EQ(at({6.0, 0.85}), kAccepted) << "the ray leaves the doorway at y = 0.45";
  EXPECT_EQ(at({6.0, 1.1}), kBehind) << "and here it would at y = 0.59";
}

TEST_F(WallGate, AWallThatARayGrazesDoesNotHideWhatIsBeside) {
  eye_ = {2.7, -2.8};
  EXPECT_EQ(at({2.7, 2.5}), kAccepted) << "along the wall, 0.3 m from it";
  EXPECT_EQ(at({2.9, 2.5}), kInside) << "along it, 0.1 m from it";
}

TEST_F(WallGate, RaysPassOverLowFurniture) {
  EXPECT_EQ(at({2.2, -2.7}), kAccepted) << "behind the table";
  params_.body = {0.3, 1.9};
  EXPECT_EQ(at({1.5, -2.0}), kInside) << "nobody stands in a table, if tables count";
}

TEST_F(WallGate, AllowsForTheErrorOfDepth) {
  // Two standard deviations of 0.01 z^2: 0.18 m at 3 m, besides half a body of 0.15 m.
  EXPECT_EQ(at({2.75, 1.0}), kAccepted);
  depth_error_pm_ = 0.01;
  EXPECT_EQ(at({2.75, 1.0}), kInside) << "it may be the wall";
  EXPECT_EQ(at({2.5, 1.0}), kAccepted);
  EXPECT_EQ(at({3.1, 0.0}), kAccepted) << "posts beside the ray do not matter";
  EXPECT_EQ(at({5.0, 0.0}), kAccepted);
  EXPECT_EQ(at({3.35, 1.0}), kInside) << "the wall, or just behind it";
  EXPECT_EQ(at({4.5, 1.4}), kBehind);

  StereoCamera camera;
  EXPECT_EQ(depthErrorOf(camera), 0.0);
  camera.left.fx = 250.0;
  camera.baseline_m = 0.1;
  EXPECT_DOUBLE_EQ(depthErrorOf(camera), 0.02);
}

TEST_F(WallGate, TheMarginGrowsWithTheCovarianceOfTheViewpoint) {
  // The ray to here meets the post: it would leave the doorway at y = 0.587.
  const Vector2d place(6.0, 1.1);
  const auto sideways = [](double deviation_m) {
    Matrix2d covariance = Matrix2d::Zero();
    covariance(1, 1) = deviation_m * deviation_m;
    return covariance;
  };
  EXPECT_EQ(at(place, sideways(0.0)), kBehind);
  EXPECT_EQ(at(place, sideways(0.04)), kBehind) << "0.08 m to the side is not enough";
  EXPECT_EQ(at(place, sideways(0.045)), kAccepted) << "from 0.09 m to the side it is in view";
  Matrix2d ahead = Matrix2d::Zero();
  ahead(0, 0) = 0.045 * 0.045;
  EXPECT_EQ(at(place, ahead), kBehind) << "the doubt is along the ray";
  params_.sigmas = 1.0;
  EXPECT_EQ(at(place, sideways(0.045)), kBehind);
  params_.sigmas = 2.0;
  EXPECT_EQ(at({5.0, 2.5}, sideways(0.2)), kBehind) << "far behind the wall it stays refused";
  EXPECT_EQ(at({5.0, 2.5}, 9.0 * Matrix2d::Identity()), kAccepted) << "a lost robot's gate opens";
}

TEST_F(WallGate, ACameraThatIsSaidToBeInAWallIsNotBlind) {
  eye_ = {3.05, 2.0};
  EXPECT_EQ(at({5.0, 2.0}), kAccepted);
  EXPECT_EQ(at({1.0, 2.0}), kAccepted);
}

TEST_F(WallGate, ObservationsMayBeInTheRobotsFrame) {
  params_.observations_in_map = {{1.0, 1.5}, 0.5 * 3.14159265358979};  // It looks along y.
  EXPECT_EQ(at({1.0, 0.0}), kAccepted) << "(1, 2.5) of the map";
  EXPECT_EQ(at({0.0, -4.0}), kBehind) << "(5, 1.5) of the map";
  // The covariance is in the robot's frame too: its x is the map's y.
  params_.observations_in_map.position = {0.0, 0.0};
  Matrix2d covariance = Matrix2d::Zero();
  covariance(0, 0) = 0.045 * 0.045;
  EXPECT_EQ(at({1.1, -6.0}, covariance), kAccepted);
  EXPECT_EQ(at({1.1, -6.0}, covariance.reverse()), kBehind);
}

TEST_F(WallGate, AllocatesNothingWhenItIsCalled) {
  const GeometricGate gate = wallGate(rooms());
  Observation seen;
  seen.position_m = {5.0, 2.5};
  const Viewpoint viewpoint{Vector2d::Zero(), 0.01 * Matrix2d::Identity()};
  const long before = test::allocations();
  EXPECT_EQ(gate(seen, viewpoint), kBehind);
  EXPECT_EQ(test::allocations(), before);
}

TEST_F(WallGate, RefusesParametersThatAreNone) {
  EXPECT_THROW(wallGate(nullptr), std::invalid_argument);
  params_.sigmas = -1.0;
  EXPECT_THROW(wallGate(rooms(), params_), std::invalid_argument);
  params_.sigmas = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(wallGate(rooms(), params_), std::invalid_argument);
}

}  // namespace
}  // namespace heel
