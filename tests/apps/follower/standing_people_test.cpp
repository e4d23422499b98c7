// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/standing_people.hpp>

#include <gtest/gtest.h>

namespace heel {
namespace {

constexpr StandingPeopleParams kParams{0.2, 0.05, 0.45};

bool stays(const Eigen::Vector2d& /*place*/) { return false; }
bool leaves(const Eigen::Vector2d& /*place*/) { return true; }

Track trackAt(const Eigen::Vector2d& place_m, bool is_seen) {
  Track track;
  track.motion = startMotion(place_m, Eigen::Matrix2d::Identity() * 0.01, 1.0);
  track.observation = is_seen ? 0 : Track::kUnseen;
  return track;
}

MovingPerson personAt(const Eigen::Vector2d& place_m) {
  MovingPerson person;
  person.position = place_m;
  return person;
}

// Bug: a robot turned to and fro between two ways, one of which led through somebody whom it saw
// only when it had turned to it.
TEST(StandingPeople, StayUntilTheyAreSeenToHaveLeft) {
  std::vector<FloorDisc> standing;
  for (int i = 0; i < 3; ++i) {
    noteStanding(kParams, {personAt({1.1, 0.0})}, {trackAt({1.1, 0.0}, true)}, stays, standing);
  }
  ASSERT_EQ(standing.size(), 1U);
  EXPECT_EQ(standing[0].radius_m, 0.3);
  noteStanding(kParams, {}, {trackAt({1.1, 0.0}, false)}, stays, standing);
  noteStanding(kParams, {}, {}, stays, standing);
  EXPECT_EQ(standing.size(), 1U);
  noteStanding(kParams, {}, {}, leaves, standing);
  EXPECT_TRUE(standing.empty()) << "they have gone";
}

TEST(StandingPeople, EndWhenTheyAreSeenToBeNone) {
  std::vector<FloorDisc> standing{{{1.1, 0.0}, 0.3}};
  noteStanding(kParams, {}, {trackAt({1.0, 0.0}, true)}, stays, standing);
  EXPECT_TRUE(standing.empty()) << "it is a chair";
}

TEST(StandingPeople, WhoWalksDoesNotStand) {
  MovingPerson walker = personAt({1.1, 0.0});
  walker.velocity = {0.5, 0.0};
  std::vector<FloorDisc> standing{{{1.0, 0.0}, 0.3}};
  noteStanding(kParams, {walker}, {trackAt({1.1, 0.0}, true)}, stays, standing);
  EXPECT_TRUE(standing.empty());
}

}  // namespace
}  // namespace heel
