// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/same_scans.hpp"
#include <heel/planning/hiding_places.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace heel {
namespace {

using Eigen::Vector2d;

constexpr double kNothing_m = std::numeric_limits<double>::infinity();

constexpr auto kOpenFloor = [](const Vector2d&) { return kNothing_m; };

/// What a scanner at the origin sees of a wall across the way, 1.5 m ahead, between two places.
LaserScan wallFrom(double right_m, double left_m) {
  LaserScan scan;
  scan.first_rad = -1.5;
  scan.step_rad = 0.01;
  for (std::size_t i = 0; i <= 300; ++i) {
    const double across_m = 1.5 * std::tan(scan.angle(i));
    const bool hits = across_m > right_m && across_m < left_m;
    scan.ranges_m.push_back(static_cast<float>(hits ? std::hypot(1.5, across_m) : kNothing_m));
  }
  return scan;
}

constexpr double kPersonBody_m = 0.25;

std::vector<Vector2d> placesIn(const LaserScan& scan, const FloorPose& scanner = {},
                               Clearance clearance = kOpenFloor) {
  std::vector<Vector2d> places{{7.0, 7.0}};
  findHidingPlaces(scan, scanner, clearance, kPersonBody_m, places);
  return places;
}

TEST(HidingPlaces, SomebodyMayStandBehindTheEndOfAWall) {
  const std::vector<Vector2d> places = placesIn(wallFrom(-100.0, -0.4));
  ASSERT_EQ(places.size(), 1U);
  const Vector2d place = places.front();
  EXPECT_GT(place.x(), 1.5);
  // As near to the line of sight past the wall's end as a body is wide, which it touches.
  const Vector2d past = Vector2d(1.5, -0.4).normalized();
  EXPECT_NEAR(past.x() * place.y() - past.y() * place.x(), -kPersonBody_m, 0.02);
  EXPECT_NEAR(past.dot(place), std::hypot(1.5, 0.4) + kPersonBody_m, 0.02);
}

TEST(HidingPlaces, BothSidesOfADoorwayHide) {
  LaserScan doorway = wallFrom(-100.0, -0.4);
  const LaserScan left = wallFrom(0.4, 100.0);
  for (std::size_t i = 0; i < doorway.ranges_m.size(); ++i) {
    doorway.ranges_m[i] = std::min(doorway.ranges_m[i], left.ranges_m[i]);
  }
  const std::vector<Vector2d> places = placesIn(doorway, {{5.0, 2.0}, M_PI / 2.0});
  ASSERT_EQ(places.size(), 2U);
  const Vector2d middle = 0.5 * (places[0] + places[1]);
  EXPECT_NEAR(middle.x(), 5.0, 0.02);
  EXPECT_GT(middle.y(), 3.5);
}

TEST(HidingPlaces, AreTheSameHoweverAScannerCounts) {
  const std::vector<Vector2d> places = placesIn(wallFrom(-100.0, -0.4));
  for (const LaserScan& scan : test::sameScans(wallFrom(-100.0, -0.4))) {
    const std::vector<Vector2d> same = placesIn(scan);
    ASSERT_EQ(same.size(), places.size());
    EXPECT_NEAR((same.front() - places.front()).norm(), 0.0, 1e-9);
  }
}

// A wall that is 1 m thick.
TEST(HidingPlaces, NobodyStandsInsideOfWhatHidesThem) {
  const auto beyond = [](const Vector2d& place) {
    return std::max(std::abs(place.x() - 2.0) - 0.5, place.y() + 0.4);
  };
  const std::vector<Vector2d> places = placesIn(wallFrom(-100.0, -0.4), {}, beyond);
  ASSERT_EQ(places.size(), 1U);
  EXPECT_GE(places.front().x(), 2.5 + kPersonBody_m - 0.05);
  EXPECT_LT(places.front().x(), 2.5 + kPersonBody_m);
}

TEST(HidingPlaces, WhatIsNarrowerThanABodyHidesNobodyNorDoesAWall) {
  EXPECT_TRUE(placesIn(wallFrom(-0.2, 0.2)).empty());
  EXPECT_TRUE(placesIn(wallFrom(-100.0, 100.0)).empty()) << "nothing jumps";
  EXPECT_TRUE(placesIn({}).empty());
}

TEST(HidingPlaces, NobodyHidesBehindWhatIsNoRange) {
  for (const float bad : {0.0F, -1.0F, std::nanf("")}) {
    LaserScan scan = wallFrom(-100.0, 100.0);
    for (std::size_t i = 100; i < 200; ++i) scan.ranges_m[i] = bad;
    EXPECT_TRUE(placesIn(scan).empty()) << bad;
  }
}

}  // namespace
}  // namespace heel
