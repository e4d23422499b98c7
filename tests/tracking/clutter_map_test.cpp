// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/tracking/clutter_map.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace heel {
namespace {

constexpr double kCell_m = 0.25;
constexpr double kCell_m2 = kCell_m * kCell_m;
constexpr double kPrior = 0.1;  // Things a square metre.

/// The middle of a cell, where no other cell has a say.
Eigen::Vector2d middle(int x, int y) { return {(x + 0.5) * kCell_m, (y + 0.5) * kCell_m}; }

SightOf everywhere(Sight sight) {
  return [sight](const Eigen::Vector2d&) { return sight; };
}

TEST(ClutterMap, KnowsNothingAtFirst) {
  const ClutterMap map;
  EXPECT_NEAR(map.density({0, 0}, 0.0).things_per_m2, kPrior, 1e-12);
  EXPECT_NEAR(map.density({-3.1, 17.7}, 0.0).things_per_m2, kPrior, 1e-12);
}

TEST(ClutterMap, AFloorSeenFreeHasFewerThings) {
  ClutterMap map;
  map.look({0, 0}, everywhere(Sight::kFree), 3.0);
  map.look({0, 0}, everywhere(Sight::kFree), 6.0);
  EXPECT_NEAR(map.density(middle(4, -3), 0.0).things_per_m2, kPrior / (1.0 + 9.0), 1e-8);
  EXPECT_NEAR(map.density({0.4321, -0.9876}, 0.0).things_per_m2, kPrior / (1.0 + 9.0), 1e-8)
      << "between the cells too";
}

TEST(ClutterMap, WhatIsNotSeenThroughStaysUnknown) {
  ClutterMap map;
  for (const Sight sight : {Sight::kUnknown, Sight::kOutside, Sight::kHidden}) {
    map.look({0, 0}, everywhere(sight), 10.0);
  }
  map.look({0, 0}, {}, 10.0);
  map.look({0, 0}, everywhere(Sight::kFree), 0.0);
  map.look({0, 0}, everywhere(Sight::kFree), -1.0);
  EXPECT_NEAR(map.density({1, 1}, 0.0).things_per_m2, kPrior, 1e-12);
}

TEST(ClutterMap, LooksAtEachPlaceByItself) {
  ClutterMap map;
  map.look(
      {0, 0},
      [](const Eigen::Vector2d& place) { return place.x() > 1.0 ? Sight::kFree : Sight::kHidden; },
      9.0);
  EXPECT_NEAR(map.density(middle(8, 0), 0.0).things_per_m2, kPrior / 10.0, 1e-8);
  EXPECT_NEAR(map.density(middle(0, 0), 0.0).things_per_m2, kPrior, 1e-12);
}

TEST(ClutterMap, CountsNothingOutOfRange) {
  ClutterMap map;
  map.look({1, 0}, everywhere(Sight::kFree), 9.0);
  EXPECT_NEAR(map.density({8.8, 0}, 0.0).things_per_m2, kPrior / 10.0, 1e-8);
  EXPECT_NEAR(map.density({-6.8, 0}, 0.0).things_per_m2, kPrior / 10.0, 1e-8);
  EXPECT_NEAR(map.density({9.4, 0}, 0.0).things_per_m2, kPrior, 1e-12);
  EXPECT_NEAR(map.density({8.2, 7.2}, 0.0).things_per_m2, kPrior, 1e-12) << "it is a circle";
}

TEST(ClutterMap, AThingIsWhereItWasObserved) {
  ClutterMap map;
  map.add({middle(4, 7), 3.0, 3.0}, 0.0);
  EXPECT_NEAR(map.density(middle(4, 7), 0.0).things_per_m2,
              (kPrior * kCell_m2 + 3.0) / 4.0 / kCell_m2, 1e-5);
  EXPECT_NEAR(map.density(middle(5, 7), 0.0).things_per_m2, kPrior, 1e-12);
  map.add({middle(4, 7), 1000.0, 1000.0}, 0.0);
  EXPECT_NEAR(map.density(middle(4, 7), 0.0).things_per_m2, 1.0 / kCell_m2, 0.02)
      << "no more than one a cell";
  EXPECT_LE(map.density(middle(4, 7), 0.0).things_per_m2, 1.0 / kCell_m2);
}

TEST(ClutterMap, NoCellHoldsMoreThanOneThing) {
  ClutterMapParams params;
  params.density_per_m2 = 100.0;
  const ClutterMap map(params);
  EXPECT_NEAR(map.density({0, 0}, 0.0).things_per_m2, 1.0 / kCell_m2, 1e-9);
}

TEST(ClutterMap, WhatMayBeAThingCountsByItsProbability) {
  ClutterMap map;
  map.add({middle(0, 0), 2.0, 0.5}, 0.0);
  EXPECT_NEAR(map.density(middle(0, 0), 0.0).things_per_m2,
              (kPrior * kCell_m2 + 0.5) / 3.0 / kCell_m2, 1e-6);
  map.add({middle(9, 9), 4.0, 0.0}, 0.0);
  EXPECT_NEAR(map.density(middle(9, 9), 0.0).things_per_m2, kPrior / 5.0, 1e-7)
      << "a person is no thing";
}

TEST(ClutterMap, WhatMayBeAPersonCountsAsOneByThatProbability) {
  ClutterMap map;
  EXPECT_EQ(map.density(middle(0, 0), 0.0).people_per_m2, 0.0);
  map.add({middle(0, 0), 2.0, 0.5}, 0.0);
  EXPECT_NEAR(map.density(middle(0, 0), 0.0).people_per_m2, 1.5 / 3.0 / kCell_m2, 1e-6);
  map.look({0, 0}, everywhere(Sight::kFree), 6.0);
  EXPECT_NEAR(map.density(middle(0, 0), 0.0).people_per_m2, 1.5 / 9.0 / kCell_m2, 1e-6);
  EXPECT_NEAR(map.density(middle(0, 0), 0.0, {middle(0, 0), 2.0, 0.5}).people_per_m2, 0.0, 1e-6);
}

TEST(ClutterMap, WhoStoodStaysAsLikelyAsTheyDidForThatShareOfTheTime) {
  ClutterMap map;
  map.add({middle(0, 0), 4.0, 1.0}, 10.0);
  const ClutterDensity then = map.density(middle(0, 0), 10.0);
  const ClutterDensity later = map.density(middle(0, 0), 16.0);
  EXPECT_NEAR(later.people_per_m2, then.people_per_m2 * 3.0 / (3.0 + 6.0), 1e-6);
  EXPECT_EQ(later.things_per_m2, then.things_per_m2) << "things stay";
}

// Bug: a clock that was set back by an hour let nobody go for an hour.
TEST(ClutterMap, WhoStoodGoesWhenTheClockWasSetBackToo) {
  ClutterMap map;
  map.add({middle(3, 3), 10.0, 0.0}, 4000.0);
  map.setClock(0.0);
  const double then = map.density(middle(3, 3), 0.0).people_per_m2;
  EXPECT_NEAR(map.density(middle(3, 3), 10.0).people_per_m2, 0.5 * then, 1e-6);
}

TEST(ClutterMap, SharesAThingBetweenTheCellsAround) {
  ClutterMap map;
  map.add({{2 * kCell_m, 3 * kCell_m}, 4.0, 4.0}, 0.0);  // Where four cells meet.
  for (const int x : {1, 2}) {
    for (const int y : {2, 3}) {
      EXPECT_NEAR(map.density(middle(x, y), 0.0).things_per_m2,
                  (kPrior * kCell_m2 + 1.0) / 2.0 / kCell_m2, 1e-5);
    }
  }
  EXPECT_NEAR(map.density(middle(3, 3), 0.0).things_per_m2, kPrior, 1e-12);
  // A quarter of each of the four, a quarter of which it had itself.
  EXPECT_NEAR(map.density({2 * kCell_m, 3 * kCell_m}, 0.0).things_per_m2,
              (kPrior * kCell_m2 + 1.0) / 2.0 / kCell_m2, 1e-5);
}

TEST(ClutterMap, TheShareOfTimeCountsThatAThingWasThere) {
  ClutterMap map;
  map.add({middle(2, 2), 5.0, 5.0}, 0.0);
  const double always = map.density(middle(2, 2), 0.0).things_per_m2;
  map.look({0, 0}, everywhere(Sight::kFree), 5.0);
  EXPECT_NEAR(map.density(middle(2, 2), 0.0).things_per_m2,
              (kPrior * kCell_m2 + 5.0) / 11.0 / kCell_m2, 1e-5);
  EXPECT_LT(map.density(middle(2, 2), 0.0).things_per_m2, always);
}

TEST(ClutterMap, IsATorusOf40Meters) {
  ClutterMap map;
  map.add({middle(-1, -1), 3.0, 3.0}, 0.0);
  const double there = map.density(middle(-1, -1), 0.0).things_per_m2;
  EXPECT_GT(there, 5.0);
  EXPECT_NEAR(map.density(middle(0, 0), 0.0).things_per_m2, kPrior, 1e-12);
  EXPECT_NEAR(map.density(middle(-1, -1) + Eigen::Vector2d(40, 0), 0.0).things_per_m2, there, 1e-9);
  EXPECT_NEAR(map.density(middle(-1, -1) - Eigen::Vector2d(80, 400), 0.0).things_per_m2, there,
              1e-9);
  EXPECT_NEAR(map.density(middle(-1, -1) + Eigen::Vector2d(20, 0), 0.0).things_per_m2, kPrior,
              1e-12);
  map.look({1000, 1000}, everywhere(Sight::kFree), 9.0);
  EXPECT_NEAR(map.density({1001, 1001}, 0.0).things_per_m2, kPrior / 10.0, 1e-8);
}

TEST(ClutterMap, RejectsBadParameters) {
  const auto with = [](auto change) {
    ClutterMapParams params;
    change(params);
    ClutterMap map(params);
  };
  EXPECT_NO_THROW(with([](ClutterMapParams&) {}));
  EXPECT_THROW(with([](ClutterMapParams& p) { p.density_per_m2 = 0.0; }), std::invalid_argument);
  EXPECT_THROW(with([](ClutterMapParams& p) { p.prior_s = 0.0; }), std::invalid_argument);
}

}  // namespace
}  // namespace heel
