// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/mapping/drawn_rooms.hpp"
#include <heel/mapping/scan_beams.hpp>
#include <heel/mapping/scan_map.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace heel {
namespace {

TEST(ScanBeams, SpreadsItsBeamsOverTheUsableOnes) {
  LaserScan scan;
  scan.first_rad = -1.0;
  scan.step_rad = 0.01;
  scan.ranges_m.assign(200, 2.0F);
  scan.ranges_m[3] = 0.0F;
  ScanBeamsParams params;
  params.beams = 20;
  ScanBeams beams({{0.1, 0.0}, 0.0}, params);
  const BeamEnds& ends = beams.choose(scan, {});
  ASSERT_EQ(ends.size(), 20U);
  double last = -2.0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const double x = static_cast<double>(ends.x[i]) - 0.1, y = static_cast<double>(ends.y[i]);
    EXPECT_NEAR(std::hypot(x, y), 2.0, 1e-6) << "measured from the scanner's place";
    if (i > 0) {
      EXPECT_NEAR(std::atan2(y, x) - last, 0.1, 0.011);
    }
    last = std::atan2(y, x);
  }
}

TEST(ScanBeams, LeavesOutBeamsThatEndOnPeople) {
  LaserScan scan;
  scan.first_rad = -0.5;
  scan.step_rad = 0.01;
  scan.ranges_m.assign(101, 3.0F);
  scan.ranges_m[50] = 2.0F;  // Straight ahead: somebody's leg.
  ScanBeamsParams params;
  params.beams = 1000;
  ScanBeams beams({}, params);
  EXPECT_EQ(beams.choose(scan, {}).size(), 101U);
  EXPECT_EQ(beams.choose(scan, {{{2.1, 0.0}, 0.3}}).size(), 100U);
  EXPECT_EQ(beams.choose(scan, {{{3.0, 0.0}, 9.0}}).size(), 0U);
}

TEST(ScanResiduals, TellsWhatIsInTheWayFromWhatGoesThroughWalls) {
  const OccupancyGrid room = test::emptyRoom(4.0, 4.0);
  const LikelihoodField field(room);
  const FloorPose pose{{2.0, 2.0}, 0.0};
  BeamEnds ends;
  ends.add({2.0, 0.0});   // On the wall.
  ends.add({0.0, 2.05});  // On the wall, nearly.
  ends.add({1.0, 0.0});   // In the room: somebody.
  ends.add({3.0, 0.0});   // Behind the wall.
  const ScanResiduals r = scanResiduals(field, ends, pose, {}, 0.2);
  EXPECT_EQ(r.beams, 4);
  EXPECT_DOUBLE_EQ(r.explained, 0.5);
  EXPECT_DOUBLE_EQ(r.shorter, 0.25);
  EXPECT_DOUBLE_EQ(r.beyond, 0.25);
  EXPECT_DOUBLE_EQ(r.fit(), 0.5 / (0.5 + 0.25 + 0.25 * 0.25));
  EXPECT_DOUBLE_EQ(ScanResiduals{}.fit(), 1.0);
}

TEST(ScanMap, DrawsTheRoomThatWasScanned) {
  const OccupancyGrid room = test::oddRoom();
  ScanMap map;
  EXPECT_THROW(map.grid(), std::invalid_argument);
  for (const FloorPose& pose :
       {FloorPose{{1.0, 1.0}, 0.3}, FloorPose{{4.0, 1.2}, 0.0}, FloorPose{{6.5, 4.0}, 0.0},
        FloorPose{{3.0, 4.5}, 1.0}, FloorPose{{4.0, 2.5}, 2.0}}) {
    for (int k = 0; k < 3; ++k) map.add(pose, test::scanOf(room, pose, 1801, 6.28));
  }
  const OccupancyGrid drawn = map.grid();
  const LikelihoodField field(room);
  int free = 0, wrong = 0;
  for (GridCell c; c.y < room.height(); ++c.y) {
    for (c.x = 0; c.x < room.width(); ++c.x) {
      const Occupancy now = drawn.at(room.center(c));
      free += now == Occupancy::kFree ? 1 : 0;
      const bool known = now != Occupancy::kUnknown;
      wrong += known && now != room.at(c) && field.distance_m(room.center(c)) > 0.08 ? 1 : 0;
    }
  }
  EXPECT_GT(free, 15000) << "of 48 m2";
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(drawn.at(Eigen::Vector2d(4.0, 3.0)), Occupancy::kFree);
  EXPECT_EQ(drawn.at(Eigen::Vector2d(2.02, 1.7)), Occupancy::kOccupied) << "the pillar's side";
  EXPECT_EQ(drawn.at(Eigen::Vector2d(2.25, 1.75)), Occupancy::kUnknown) << "inside it";
  EXPECT_EQ(drawn.at(Eigen::Vector2d(50.0, 0.0)), Occupancy::kUnknown);
}

TEST(ScanMap, RefusesAScanThatWasTakenBeyondWhatAMapCanReach) {
  const LaserScan scan{0.0, 0.1, {1.0F, 1.0F}};
  for (const double far_m : {2000.0, 1e10, -1e300}) {
    ScanMap map;
    map.add({}, scan);
    EXPECT_THROW(map.add({{far_m, far_m}, 0.0}, scan), std::runtime_error) << far_m;
    EXPECT_NO_THROW(map.grid()) << "what was there before is whole";
  }
}

TEST(ScanMap, LeavesOutBeamsWithoutAnAngle) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  ScanMap map;
  map.add({}, {kNaN, 0.1, {1.0F, 1.0F}});
  map.add({}, {0.0, std::numeric_limits<double>::infinity(), {1.0F, 1.0F, 1.0F}});
  map.add({{0.0, 0.0}, 1e308}, {1e308, 0.1, {1.0F, 1.0F}});
  const OccupancyGrid grid = map.grid();
  EXPECT_EQ(std::count(grid.cells().begin(), grid.cells().end(), Occupancy::kOccupied), 0);
}

}  // namespace
}  // namespace heel
