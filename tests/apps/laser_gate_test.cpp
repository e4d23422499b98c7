// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/follower/laser_gate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace heel {
namespace {

using Eigen::Vector2d;

constexpr double kPi = 3.14159265358979323846;

/// A scanner somewhere in a room of 6 m x 6 m; the map shows its walls and a round pillar.
class LaserGateTest : public testing::Test {
 protected:
  struct Disc {
    Vector2d center;
    double radius_m;
  };

  static double mapped(const Vector2d& p) {
    const double walls = std::min(p.minCoeff(), (Vector2d(6.0, 6.0) - p).minCoeff());
    return std::min(walls, (p - Vector2d(2.0, 4.5)).norm() - 0.3);
  }

  double clearance(const Vector2d& p) const {
    double least = mapped(p);
    for (const Disc& d : discs) least = std::min(least, (p - d.center).norm() - d.radius_m);
    return least;
  }

  LaserScan scan(double view_rad = 2.0 * kPi) const {
    LaserScan made;
    made.first_rad = -0.5 * view_rad;
    made.step_rad = kPi / 180.0;
    for (int i = 0; i <= static_cast<int>(std::lround(view_rad / made.step_rad)); ++i) {
      const double angle = made.angle(static_cast<std::size_t>(i));
      const Vector2d along(std::cos(angle), std::sin(angle));
      double range = 0.0;
      for (double free = 1.0; free > 1e-4 && range < 20.0; range += free) {
        free = clearance(scanner * Vector2d(range * along));
      }
      made.ranges_m.push_back(static_cast<float>(range));
    }
    return made;
  }

  void person(const Vector2d& at) {
    discs.push_back({at + Vector2d(0.0, 0.12), 0.06});
    discs.push_back({at - Vector2d(0.0, 0.12), 0.06});
  }

  GateVerdict judge(const Vector2d& place) const {
    Observation seen;
    seen.position_m = place;
    return gate.judge(seen);
  }

  FloorPose scanner{{1.0, 3.0}, 0.4};
  std::vector<Disc> discs;
  LaserGate gate{mapped};
};

TEST_F(LaserGateTest, RejectsWhatHasNoLegs) {
  const LaserScan seen = scan();
  gate.step(&seen, scanner, 0.1);
  EXPECT_EQ(judge({3.0, 3.0}), GateVerdict::kNoLegs) << "free floor";
  EXPECT_EQ(judge({5.6, 3.0}), GateVerdict::kNoLegs) << "the wall, seen too near";
  EXPECT_EQ(judge({2.0, 4.3}), GateVerdict::kNoLegs) << "the pillar";
}

TEST_F(LaserGateTest, AcceptsAPersonWhereverTheyStand) {
  for (const Vector2d& at :
       {Vector2d(3.0, 3.0), Vector2d(5.6, 2.0), Vector2d(4.0, 5.6), Vector2d(1.0, 1.5)}) {
    discs.clear();
    person(at);
    const LaserScan seen = scan();
    gate.step(&seen, scanner, 0.1);
    EXPECT_EQ(judge(at), GateVerdict::kAccepted) << at.transpose();
    EXPECT_EQ(judge(at + Vector2d(0.2, 0.1)), GateVerdict::kAccepted) << "seen a little off";
  }
}

TEST_F(LaserGateTest, RejectsAWideThingThatTheMapDoesNotShow) {
  for (double y = 2.4; y < 3.7; y += 0.1) discs.push_back({{3.5, y}, 0.1});  // a shelf
  LaserScan seen = scan();
  gate.step(&seen, scanner, 0.1);
  EXPECT_EQ(judge({3.5, 3.0}), GateVerdict::kNoLegs);
  person({2.9, 3.0});
  seen = scan();
  gate.step(&seen, scanner, 0.1);
  EXPECT_EQ(judge({2.9, 3.0}), GateVerdict::kAccepted) << "before the shelf";
}

TEST_F(LaserGateTest, SaysNothingOfWhatItDoesNotSee) {
  discs.push_back({{2.5, 3.0}, 0.4});  // a tub; somebody may stand behind it
  LaserScan seen = scan();
  gate.step(&seen, scanner, 0.1);
  EXPECT_EQ(judge({4.0, 3.0}), GateVerdict::kAccepted);
  seen = scan(kPi / 2.0);
  gate.step(&seen, scanner, 0.1);
  EXPECT_EQ(judge({1.0, 1.0}), GateVerdict::kAccepted) << "to the side of its view";
  std::fill(seen.ranges_m.begin(), seen.ranges_m.end(), std::numeric_limits<float>::quiet_NaN());
  gate.step(&seen, scanner, 0.1);
  EXPECT_EQ(judge({3.0, 2.0}), GateVerdict::kAccepted);
}

TEST_F(LaserGateTest, AnOldScanSaysNothing) {
  EXPECT_EQ(judge({3.0, 3.0}), GateVerdict::kAccepted) << "no scan yet";
  const LaserScan seen = scan();
  gate.step(&seen, scanner, 0.1);
  gate.step(nullptr, scanner, 0.2);
  EXPECT_EQ(judge({3.0, 3.0}), GateVerdict::kNoLegs);
  gate.step(nullptr, scanner, 0.2);
  EXPECT_EQ(judge({3.0, 3.0}), GateVerdict::kAccepted);
}

TEST_F(LaserGateTest, BeamsWithoutAnEndSeeFreeFloor) {
  LaserScan seen = scan();
  std::fill(seen.ranges_m.begin(), seen.ranges_m.end(), std::numeric_limits<float>::infinity());
  gate.step(&seen, scanner, 0.1);
  EXPECT_EQ(judge({3.0, 3.0}), GateVerdict::kNoLegs);
}

TEST_F(LaserGateTest, FarAwayAllowsForTheDepthsError) {
  LaserGateParams params;
  params.depth_error_pm = 0.03;
  gate = LaserGate(mapped, params);
  person({5.0, 3.0});
  const LaserScan seen = scan();
  gate.step(&seen, scanner, 0.1);
  EXPECT_EQ(judge({4.2, 3.0}), GateVerdict::kAccepted);
  gate = LaserGate(mapped);
  gate.step(&seen, scanner, 0.1);
  EXPECT_EQ(judge({4.2, 3.0}), GateVerdict::kNoLegs);
}

TEST_F(LaserGateTest, RefusesWhatMakesNoSense) {
  EXPECT_THROW(LaserGate({}), std::invalid_argument);
  LaserGateParams params;
  params.reach_m = -0.1;
  EXPECT_THROW(LaserGate(mapped, params), std::invalid_argument);
}

}  // namespace
}  // namespace heel
