// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/following_plan.hpp>
#include <heel/planning/plan_checks.hpp>
#include <heel/planning/plan_file.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace heel {
namespace {

using A = FollowingAction;
using C = FollowingCondition;

PetriPlan shipped(const std::string& name) {
  const auto folder = std::filesystem::path(HEEL_SOURCE_DIR) / "apps" / "plans";
  return loadPlan(folder / (name + ".pnml"), followingVocabulary());
}

/// Runs a shipped plan; tells what the robot does after a step in which these conditions hold.
class Following {
 public:
  explicit Following(const std::string& name) : runner_(shipped(name)) {}

  A operator()(const std::vector<C>& conditions) {
    FollowingFacts facts;
    for (const C c : conditions) facts[c] = true;
    outcome = runner_.step(facts).outcome;
    return currentAction(runner_);
  }

  PlanOutcome outcome = PlanOutcome::kRunning;

 private:
  PlanRunner runner_;
};

/// What a plan does about a loss: the paper's goes there, and then turns; ours looks first.
class FollowingPlans : public testing::TestWithParam<const char*> {
 protected:
  bool isPaper() const { return std::string(GetParam()) == "paper"; }
  A first() const { return isPaper() ? A::kGoToLastSeen : A::kSeek; }
  A second() const { return isPaper() ? A::kSeek : A::kGoToLastSeen; }
  C between() const { return isPaper() ? C::kArrived : C::kLookedAround; }
};
INSTANTIATE_TEST_SUITE_P(Shipped, FollowingPlans, testing::Values("paper", "search"));

TEST(FollowingPlan, EveryNameIsItsOwn) {
  const PlanVocabulary& words = followingVocabulary();
  EXPECT_EQ(std::set<std::string>(words.actions.begin(), words.actions.end()).size(),
            kFollowingActions);
  EXPECT_EQ(std::set<std::string>(words.conditions.begin(), words.conditions.end()).size(),
            kFollowingConditions);
  EXPECT_STREQ(nameOf(A::kGoToLastSeen), "goToLastSeen");
  EXPECT_EQ(words.conditions[static_cast<std::size_t>(C::kDone)], "done");
}

TEST_P(FollowingPlans, IsDrawn) {
  const PetriPlan plan = shipped(GetParam());
  for (const auto& place : plan.net.places) EXPECT_TRUE(place.graphics.position) << place.id;
  for (const auto& t : plan.net.transitions) EXPECT_TRUE(t.graphics.position) << t.id;
}

TEST_P(FollowingPlans, WaitsForThePerson) {
  Following does(GetParam());
  EXPECT_EQ(does({}), A::kStop);
  EXPECT_EQ(does({C::kTargetLost}), A::kStop);
  EXPECT_EQ(does({C::kTargetSeen}), A::kFollow);
}

TEST_P(FollowingPlans, FollowsLosesAndFinds) {
  Following does(GetParam());
  EXPECT_EQ(does({C::kTargetSeen}), A::kFollow);
  EXPECT_EQ(does({C::kTargetSeen, C::kNear}), A::kFace);
  EXPECT_EQ(does({C::kTargetSeen}), A::kFace);  // neither near nor far
  EXPECT_EQ(does({C::kTargetSeen, C::kFar}), A::kFollow);
  EXPECT_EQ(does({}), A::kFollow);  // out of view, but not lost
  EXPECT_EQ(does({C::kTargetLost}), first());
  EXPECT_EQ(does({C::kTargetLost}), first());
  EXPECT_EQ(does({C::kTargetLost, between()}), second());
  EXPECT_EQ(does({C::kTargetLost}), second());
  EXPECT_EQ(does({C::kTargetSeen}), A::kFollow);
}

TEST_P(FollowingPlans, FindsOnTheWayToWhereThePersonWasSeen) {
  Following does(GetParam());
  does({C::kTargetSeen});
  EXPECT_EQ(does({C::kTargetLost}), first());
  EXPECT_EQ(does({C::kTargetSeen, between()}), A::kFollow);
}

TEST_P(FollowingPlans, LosesWhoIsNear) {
  Following does(GetParam());
  does({C::kTargetSeen});
  EXPECT_EQ(does({C::kTargetSeen, C::kNear}), A::kFace);
  EXPECT_EQ(does({C::kTargetLost}), first());
}

TEST_P(FollowingPlans, EndsBesideThePerson) {
  Following does(GetParam());
  does({C::kTargetSeen});
  EXPECT_EQ(does({C::kTargetSeen, C::kDone}), A::kFollow);
  EXPECT_EQ(does({C::kTargetSeen, C::kNear, C::kDone}), A::kFace);
  EXPECT_EQ(does({C::kTargetSeen, C::kNear, C::kDone}), A::kStop);
  EXPECT_EQ(does.outcome, PlanOutcome::kReached);
}

TEST_P(FollowingPlans, StopsWhileBlindAndGoesOn) {
  Following does(GetParam());
  does({C::kTargetSeen});
  EXPECT_EQ(does({C::kBlind}), A::kStop);
  EXPECT_EQ(does({C::kBlind}), A::kStop);
  EXPECT_EQ(does({C::kTargetSeen}), A::kFollow);
  does({C::kTargetLost});
  does({C::kTargetLost, between()});
  EXPECT_EQ(does({C::kTargetLost, C::kBlind}), A::kStop);
  EXPECT_EQ(does({C::kTargetLost}), second());
  EXPECT_EQ(does({C::kTargetLost, C::kBlind}), A::kStop);
  EXPECT_EQ(does({C::kTargetSeen}), A::kFollow);
  EXPECT_EQ(does.outcome, PlanOutcome::kRunning);
}

TEST(PaperPlan, FailsAfterAFullTurn) {
  Following does("paper");
  does({C::kTargetSeen});
  does({C::kTargetLost});
  does({C::kTargetLost, C::kArrived});
  EXPECT_EQ(does({C::kTargetLost, C::kLookedAround}), A::kSeek);
  EXPECT_EQ(does({C::kTargetLost, C::kFullTurn}), A::kStop);
  EXPECT_EQ(does.outcome, PlanOutcome::kFailed);
}

TEST(PaperPlan, FindsAtTheVeryEndOfTheTurn) {
  Following does("paper");
  does({C::kTargetSeen});
  does({C::kTargetLost});
  does({C::kTargetLost, C::kArrived});
  EXPECT_EQ(does({C::kTargetSeen, C::kFullTurn}), A::kFollow);
}

TEST(SearchPlan, SearchesAfterAShortLook) {
  Following does("search");
  does({C::kTargetSeen});
  does({C::kTargetLost});
  EXPECT_EQ(does({C::kTargetLost, C::kLookedAround}), A::kGoToLastSeen);
  EXPECT_EQ(does({C::kTargetLost, C::kArrived}), A::kSearch);
  EXPECT_EQ(does({C::kTargetLost, C::kFullTurn}), A::kSearch);
  EXPECT_EQ(does({C::kTargetLost, C::kArrived}), A::kSearch);  // at one of the places to look at
  EXPECT_EQ(does({C::kTargetSeen}), A::kFollow);
}

TEST(SearchPlan, FailsWhenItsTimeIsOver) {
  Following does("search");
  does({C::kTargetSeen});
  does({C::kTargetLost});
  does({C::kTargetLost, C::kLookedAround});
  does({C::kTargetLost, C::kArrived});
  EXPECT_EQ(does({C::kTargetLost, C::kSearchOver}), A::kStop);
  EXPECT_EQ(does.outcome, PlanOutcome::kFailed);
}

// Whatever is true in whatever order, the robot does one thing at a time, beside being held.
TEST_P(FollowingPlans, DoesOneThingAtATime) {
  PlanRunner runner(shipped(GetParam()));
  unsigned random = 1;
  int ends = 0;
  for (int i = 0; i < 20000; ++i) {
    random = random * 1664525U + 1013904223U;
    const PlanStep& step =
        runner.step([&](int c) { return (random >> (10 + c) & 1U) != 0 && i % 7 != c; });
    int moving = 0;
    for (const int action : step.active) moving += action != static_cast<int>(A::kStop) ? 1 : 0;
    EXPECT_LE(moving, 1);
    if (step.outcome == PlanOutcome::kRunning) continue;
    EXPECT_EQ(moving, 0);
    ++ends;
    runner.reset();
  }
  EXPECT_GT(ends, 10);
}

}  // namespace
}  // namespace heel
