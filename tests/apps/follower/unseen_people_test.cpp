// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/unseen_people.hpp>

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace heel {
namespace {

constexpr UnseenPeopleParams kParams{2.0, 0.05, 0.45};

constexpr auto stays = [](const Eigen::Vector2d& /*place*/) { return false; };
constexpr auto leaves = [](const Eigen::Vector2d& /*place*/) { return true; };

MovingPerson personAt(const Eigen::Vector2d& place_m, double x_mps = 0.0) {
  MovingPerson person;
  person.position = place_m;
  person.velocity = {x_mps, 0.0};
  person.rests_s = x_mps == 0.0 ? 3.0 : 0.0;
  return person;
}

struct Memory {
  UnseenPeople unseen{kParams};
  std::vector<MovingPerson> people;
  void step(double stamp_s, std::vector<MovingPerson> seen,
            FunctionRef<bool(const Eigen::Vector2d&)> has_left = stays) {
    people = std::move(seen);
    unseen.step(stamp_s, people, has_left);
  }
};

// Bug: a robot turned to and fro between two ways, one of which led through somebody whom it saw
// only when it had turned to it.
TEST(UnseenPeople, WhoStandsStaysUntilTheyAreSeenToHaveLeft) {
  Memory memory;
  for (int i = 0; i < 3; ++i) memory.step(i, {personAt({1.1, 0.0})});
  ASSERT_EQ(memory.unseen.resting().size(), 1U);
  EXPECT_EQ(memory.people.size(), 1U);
  EXPECT_EQ(memory.unseen.resting()[0].radius_m, 0.3);
  memory.step(4.0, {});
  EXPECT_EQ(memory.unseen.resting().size(), 1U);
  EXPECT_EQ(memory.people.size(), 1U);
  memory.step(5.0, {}, leaves);
  EXPECT_TRUE(memory.unseen.resting().empty()) << "they have gone";
  EXPECT_TRUE(memory.people.empty());
}

// Bug: a robot stood for minutes before somebody who had stood behind a door, and left unseen.
TEST(UnseenPeople, WhoStandsStaysForHalfAMinute) {
  Memory memory;
  memory.step(0.0, {personAt({1.1, 0.0})});
  memory.step(2.0, {personAt({3.0, 0.0})});
  EXPECT_EQ(memory.people.size(), 2U);
  memory.step(29.0, {});
  EXPECT_EQ(memory.people.size(), 2U);
  memory.step(31.0, {});
  ASSERT_EQ(memory.people.size(), 1U);
  EXPECT_EQ(memory.people[0].position.x(), 3.0);
}

// Bug: whoever walked up to the robot and was not told from a thing for 0.3 s was nobody: it set
// off again.
TEST(UnseenPeople, WhoWalksWalksOnForAWhile) {
  Memory memory;
  memory.step(0.0, {personAt({3.0, 0.0}, -1.0)});
  for (const double later_s : {0.5, 1.5}) {
    memory.step(later_s, {});
    ASSERT_EQ(memory.people.size(), 1U);
    EXPECT_NEAR(memory.people[0].position.x(), 3.0 - later_s, 1e-9);
    EXPECT_EQ(memory.people[0].velocity.x(), -1.0);
    EXPECT_TRUE(memory.unseen.resting().empty()) << "no path leads around them";
  }
  memory.step(1.6, {personAt({1.3, 0.0}, -1.0)});
  EXPECT_EQ(memory.people.size(), 1U) << "these are them";
  memory.step(2.0, {}, leaves);
  EXPECT_TRUE(memory.people.empty());
  memory.step(3.0, {personAt({3.0, 0.0}, -1.0)});
  memory.step(5.1, {});
  EXPECT_TRUE(memory.people.empty()) << "who knows where they are";
}

// Bug: somebody who pressed against the robot and stepped about closed and opened ways ten times a
// second; it turned to and fro between them for three quarters of a minute.
TEST(UnseenPeople, WhoHasJustStoppedClosesNoWayYet) {
  Memory memory;
  MovingPerson stopped = personAt({1.1, 0.0});
  stopped.rests_s = 0.0;
  memory.step(0.0, {stopped});
  EXPECT_TRUE(memory.unseen.resting().empty());
  memory.step(10.0, {});
  EXPECT_EQ(memory.people.size(), 1U) << "but stays where they were";
}

TEST(UnseenPeople, WhoIsSeenByAnotherSensorHasNotJustCome) {
  Memory memory;
  memory.step(0.0, {personAt({1.0, 0.0})});
  memory.step(4.0, {personAt({1.1, 0.0})});
  ASSERT_EQ(memory.unseen.resting().size(), 1U);
  EXPECT_EQ(memory.unseen.resting()[0].rests_s, 7.0);
}

TEST(UnseenPeople, WhoSetsOffDoesNotStandAnyMore) {
  Memory memory;
  memory.step(0.0, {personAt({1.0, 0.0})});
  memory.step(1.0, {personAt({1.1, 0.0}, 0.5)});
  EXPECT_TRUE(memory.unseen.resting().empty());
  EXPECT_EQ(memory.people.size(), 1U);
}

}  // namespace
}  // namespace heel
