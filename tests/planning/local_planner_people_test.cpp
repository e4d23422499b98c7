// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/drive_loop.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>

namespace heel {
namespace {

using Eigen::Vector2d;

/// Whether a walker's line is free of things.
bool isFree(const test::DrawnFloor& floor, const Vector2d& from, const Vector2d& to) {
  for (int i = 0; i <= 40; ++i) {
    if (floor.clearance(from + (to - from) * (i / 40.0)) < 0.27) return false;
  }
  return true;
}

void addWalkers(test::DriveLoop& loop, int count, const Vector2d& robot, std::mt19937& random) {
  for (int tries = 0; tries < 2000 && static_cast<int>(loop.walkers.size()) < count; ++tries) {
    test::LineWalker walker;
    walker.from = test::randomFreePoint(loop.floor, 0.27, random);
    walker.to = test::randomFreePoint(loop.floor, 0.27, random);
    if ((walker.from - walker.to).norm() < 1.0 || (walker.from - robot).norm() < 1.2) continue;
    if (!isFree(loop.floor, walker.from, walker.to)) continue;
    walker.person.position = walker.from;
    loop.walkers.push_back(walker);
  }
}

/// A way around the people as they stand now, as a global planner would find one; the old way if
/// there is none.
void replan(const test::DriveLoop& loop, const Vector2d& to, std::vector<Vector2d>& path) {
  test::DrawnFloor now = loop.floor;
  for (const auto& walker : loop.walkers) {
    now.discs.push_back({walker.person.position, walker.person.radius_m + 0.06});
  }
  auto way = test::wayOn(now, loop.state().pose.position, to, 0.26);
  if (!way.empty()) path = std::move(way);
}

struct Drives {
  int drives = 0;
  int arrived = 0;
  double mean_moving_mps = 0.0;
};

/// Drives over 200 random floors with so many walkers, and checks that nothing is ever touched.
Drives driveOverRandomFloors(int walkers) {
  Drives out;
  for (unsigned seed = 0; out.drives < 200 && seed < 1000; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    const test::DrawnFloor floor = test::randomFloor(random);
    const Vector2d from = test::randomFreePoint(floor, 0.4, random);
    const Vector2d to = test::randomFreePoint(floor, 0.4, random);
    if ((to - from).norm() < 2.0) continue;
    auto path = test::wayOn(floor, from, to, 0.26);
    if (path.empty()) continue;
    ++out.drives;
    const double yaw = std::uniform_real_distribution<double>(-3.0, 3.0)(random);
    test::DriveLoop loop(floor, {from, yaw}, {}, static_cast<int>(seed % 2));
    addWalkers(loop, walkers, from, random);
    bool done = false;
    while (!done && loop.time_s() < 90.0) {
      const LocalPlan& plan = loop.step(path);
      done = plan.status == DriveStatus::kArrived;
      if (std::fmod(plan.blocked_s, 2.0) > 1.85) replan(loop, to, path);
    }
    out.arrived += done ? 1 : 0;
    out.mean_moving_mps += loop.movingSpeed() / 200.0;
    EXPECT_GT(loop.leastGap(), 0.0);
    EXPECT_GT(loop.leastPeopleGap(), 0.0);
  }
  EXPECT_EQ(out.drives, 200);
  return out;
}

TEST(LocalPlannerAmongThings, ArrivesAtSpeedAndTouchesNothingOnTwoHundredRandomFloors) {
  const Drives drives = driveOverRandomFloors(0);
  RecordProperty("arrived", drives.arrived);
  RecordProperty("moving_mm_per_s", static_cast<int>(1000.0 * drives.mean_moving_mps));
  EXPECT_EQ(drives.arrived, 200);
  EXPECT_GE(drives.mean_moving_mps, 0.24);
}

// Three people in 36 square metres walk to and fro at 1 m/s, step aside for nobody, stop only 15 cm
// before the robot and turn back after 3 s. Some hold the robot up for longer than the 90 s.
TEST(LocalPlannerAmongPeople, TouchesNobodyOnTwoHundredRandomFloors) {
  const Drives drives = driveOverRandomFloors(3);
  RecordProperty("arrived", drives.arrived);
  RecordProperty("moving_mm_per_s", static_cast<int>(1000.0 * drives.mean_moving_mps));
  EXPECT_GE(drives.arrived, 160);
}

}  // namespace
}  // namespace heel
