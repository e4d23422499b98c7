// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/drive_loop.hpp"

#include <gtest/gtest.h>

#include <random>

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

TEST(LocalPlannerAmongPeople, TouchesNothingOnTwoHundredRandomFloors) {
  int with_way = 0, arrived = 0, rolled_into = 0;
  double way = 0.0;
  for (unsigned seed = 0; with_way < 200 && seed < 1000; ++seed) {
    std::mt19937 random(seed);
    const test::DrawnFloor floor = test::randomFloor(random);
    const Vector2d from = test::randomFreePoint(floor, 0.4, random);
    const Vector2d to = test::randomFreePoint(floor, 0.4, random);
    if ((to - from).norm() < 2.0) continue;
    const auto path = test::wayOn(floor, from, to, 0.26);
    if (path.empty()) continue;
    ++with_way;
    const double yaw = std::uniform_real_distribution<double>(-3.0, 3.0)(random);
    test::DriveLoop loop(floor, {from, yaw}, {}, static_cast<int>(seed % 2));
    addWalkers(loop, 3, from, random);
    bool done = false;
    while (!done && loop.time_s() < 90.0) {
      done = loop.step(path).status == DriveStatus::kArrived;
    }
    arrived += done ? 1 : 0;
    way += loop.movingSpeed();
    EXPECT_GT(loop.leastGap(), 0.0) << "seed " << seed;
    EXPECT_GT(loop.leastPeopleGap(), 0.0) << "seed " << seed;
    if (loop.leastPeopleGap() <= 0.0) ++rolled_into;
    if (!done)
      std::printf("seed %u not arrived: %s, %s\n", seed, describe(loop.plan().status),
                  describe(loop.plan().reason));
  }
  std::printf("%d floors, %d arrived, moving speed %.3f, people touched %d\n", with_way, arrived,
              way / with_way, rolled_into);
  EXPECT_EQ(with_way, 200);
  EXPECT_GE(arrived, 190);
}

}  // namespace
}  // namespace heel
