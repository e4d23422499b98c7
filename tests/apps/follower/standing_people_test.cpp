// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/standing_people.hpp>

#include <gtest/gtest.h>

namespace heel {
namespace {

constexpr StandingPeopleParams kParams{0.2, 0.05, 0.45};

constexpr auto stays = [](const Eigen::Vector2d& /*place*/) { return false; };
constexpr auto leaves = [](const Eigen::Vector2d& /*place*/) { return true; };

MovingPerson personAt(const Eigen::Vector2d& place_m) {
  MovingPerson person;
  person.position = place_m;
  return person;
}

// Bug: a robot turned to and fro between two ways, one of which led through somebody whom it saw
// only when it had turned to it.
TEST(StandingPeople, StayUntilTheyAreSeenToHaveLeft) {
  StandingPeople standing(kParams);
  for (int i = 0; i < 3; ++i) standing.note(i, {personAt({1.1, 0.0})}, stays);
  ASSERT_EQ(standing.discs().size(), 1U);
  EXPECT_EQ(standing.discs()[0].radius_m, 0.3);
  standing.note(4.0, {}, stays);
  EXPECT_EQ(standing.discs().size(), 1U);
  standing.note(5.0, {}, leaves);
  EXPECT_TRUE(standing.discs().empty()) << "they have gone";
}

// Bug: a robot stood for minutes before somebody who had stood behind a door, and left unseen.
TEST(StandingPeople, StayForHalfAMinuteUnseen) {
  StandingPeople standing(kParams);
  standing.note(0.0, {personAt({1.1, 0.0})}, stays);
  standing.note(2.0, {personAt({3.0, 0.0})}, stays);
  EXPECT_EQ(standing.remembered(), 1U);
  standing.note(29.0, {}, stays);
  EXPECT_EQ(standing.discs().size(), 2U);
  EXPECT_EQ(standing.remembered(), 2U);
  standing.note(31.0, {}, stays);
  ASSERT_EQ(standing.discs().size(), 1U);
  EXPECT_EQ(standing.discs()[0].center.x(), 3.0);
}

TEST(StandingPeople, WhoWalksDoesNotStand) {
  MovingPerson walker = personAt({1.1, 0.0});
  walker.velocity = {0.5, 0.0};
  StandingPeople standing(kParams);
  standing.note(0.0, {personAt({1.0, 0.0})}, stays);
  standing.note(1.0, {walker}, stays);
  EXPECT_TRUE(standing.discs().empty());
}

}  // namespace
}  // namespace heel
