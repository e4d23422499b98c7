// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/planning/small_net.hpp"
#include <heel/planning/plan_checks.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace heel {
namespace {

using test::SmallNet;
using testing::ElementsAre;
using testing::IsEmpty;

const PlanVocabulary kWords = {{"walk", "wave"}, {"near", "tired"}};

std::vector<std::string> faults(const PetriNet& net) {
  std::vector<std::string> sentences;
  for (const PlanFault& fault : checkPlan(makePlan(net, kWords)).faults) {
    sentences.push_back(fault.sentence);
  }
  return sentences;
}

PlanFlaw firstFlaw(const PetriNet& net) {
  return checkPlan(makePlan(net, kWords)).faults.at(0).flaw;
}

/// begin -> walk -> goal.
SmallNet soundNet() {
  return SmallNet()
      .place("begin", 1)
      .place("walk.exec")
      .place("goal")
      .transition("walk.start", {"begin"}, {"walk.exec"})
      .transition("walk.end [near]", {"walk.exec"}, {"goal"});
}

TEST(PlanChecks, ASoundPlanHasNoFaults) {
  const PlanReport report = checkPlan(makePlan(soundNet(), kWords));
  EXPECT_THAT(report.faults, IsEmpty());
  EXPECT_EQ(report.states, 3U);
}

TEST(PlanChecks, ActionsThatRunBesideEachOtherAreSound) {
  const PetriNet net =
      SmallNet()
          .place("begin", 1)
          .place("walk.exec")
          .place("wave.exec")
          .place("walked")
          .place("waved")
          .place("goal")
          .transition("walk.start wave.start", {"begin"}, {"walk.exec", "wave.exec"})
          .transition("walk.end [near]", {"walk.exec"}, {"walked"})
          .transition("wave.end [tired]", {"wave.exec"}, {"waved"})
          .transition("both", {"walked", "waved"}, {"goal"});
  const PlanReport report = checkPlan(makePlan(net, kWords));
  EXPECT_THAT(report.faults, IsEmpty());
  EXPECT_EQ(report.states, 6U);  // begin, 2 x 2 of walking and waving, goal
}

TEST(PlanChecks, ADeadTransitionIsFound) {
  SmallNet net = soundNet();
  net.place("never").transition("late", {"never"}, {"goal"});
  EXPECT_THAT(faults(net), ElementsAre("transition 'late' (late) can never fire"));
}

TEST(PlanChecks, ATransitionWhoseGuardCannotHoldIsDead) {
  SmallNet net = soundNet();
  net.transition("walk.end [and near (not near)]", {"walk.exec"}, {"goal"});
  EXPECT_EQ(firstFlaw(net), PlanFlaw::kDeadTransition);
}

TEST(PlanChecks, AGoalThatIsMissingIsFound) {
  EXPECT_EQ(faults(SmallNet().place("a", 1).place("fail").transition("t", {"a"}, {"fail"})),
            std::vector<std::string>{"no place is named 'goal'"});
}

TEST(PlanChecks, AGoalThatCannotBeReachedIsFound) {
  const PetriNet net = SmallNet()
                           .place("a", 1)
                           .place("b")
                           .place("goal")
                           .place("fail")
                           .transition("t", {"a"}, {"fail"})
                           .transition("u", {"a", "b"}, {"goal"});
  EXPECT_THAT(faults(net), ElementsAre("transition 'u' (u) can never fire",
                                       "place 'goal' (goal) can never be reached"));
}

TEST(PlanChecks, TokensThatPileUpAreFound) {
  SmallNet net = soundNet();
  net.place("steps").transition("count", {"walk.exec"}, {"walk.exec", "steps"});
  EXPECT_THAT(faults(net), ElementsAre("place 'steps' (steps) can gather tokens without end"));
}

// The token of `b` comes back multiplied only by a way round through another place.
TEST(PlanChecks, TokensThatPileUpOnADetourAreFound) {
  SmallNet net = soundNet();
  net.place("b").place("c").place("d");
  net.transition("in", {"begin"}, {"b"})
      .transition("x", {"b"}, {"c", "c"})
      .transition("y", {"c"}, {"d"})
      .transition("z", {"d"}, {"b"})
      .transition("out", {"b"}, {"goal"});
  EXPECT_EQ(firstFlaw(net), PlanFlaw::kUnboundedPlace);
}

TEST(PlanChecks, ADeadlockIsFound) {
  SmallNet net = soundNet();
  net.place("pit").transition("walk.interrupt [tired]", {"walk.exec"}, {"pit"});
  EXPECT_THAT(faults(net),
              ElementsAre("with a token on pit neither goal nor fail can be reached any more"));
}

TEST(PlanChecks, GoingRoundForEverIsADeadlockToo) {
  SmallNet net = soundNet();
  net.place("pit").place("cave");
  net.transition("walk.interrupt [tired]", {"walk.exec"}, {"pit"})
      .transition("in", {"pit"}, {"cave"})
      .transition("out", {"cave"}, {"pit"});
  EXPECT_EQ(firstFlaw(net), PlanFlaw::kDeadlock);
}

TEST(PlanChecks, TheEndsAreNoDeadlocks) {
  SmallNet net = soundNet();
  net.place("fail").transition("walk.fail [tired]", {"walk.exec"}, {"fail"});
  EXPECT_THAT(faults(net), IsEmpty());
}

TEST(PlanChecks, AnInterruptThatLetsItsActionRunIsFound) {
  SmallNet net = soundNet();
  net.transition("walk.interrupt [tired]", {"walk.exec"}, {"walk.exec"});
  EXPECT_THAT(
      faults(net),
      ElementsAre("transition 'walk.interrupt [tired]' (walk.interrupt [tired]) ends 'walk' "
                  "without taking the token from its place"));
}

TEST(PlanChecks, AnActionThatIsNotToldOfItsEndIsFound) {
  SmallNet net = soundNet();
  net.transition("[tired]", {"walk.exec"}, {"goal"});
  EXPECT_THAT(faults(net), ElementsAre("transition '[tired]' ([tired]) takes the token from the "
                                       "place of 'walk' but does not end it"));
}

TEST(PlanChecks, AnActionThatIsStartedNowhereIsFound) {
  SmallNet net = soundNet();
  net.transition("wave.start [near]", {"begin"}, {"goal"});
  EXPECT_THAT(
      faults(net),
      ElementsAre("transition 'wave.start [near]' (wave.start [near]) starts 'wave' without "
                  "bringing a token to its place"));
}

TEST(PlanChecks, AnActionThatIsNotToldOfItsStartIsFound) {
  SmallNet net = soundNet();
  net.transition("hop", {"begin"}, {"walk.exec"});
  EXPECT_THAT(faults(net),
              ElementsAre("transition 'hop' (hop) brings a token to the place of 'walk' "
                          "but does not start it"));
}

TEST(PlanChecks, APlanWithTooManyStatesIsNotJudged) {
  SmallNet net = soundNet();  // and 15 switches beside it: 2^15 states and more
  for (int i = 0; i < 15; ++i) {
    const std::string on = "on" + std::to_string(i), off = "off" + std::to_string(i);
    net.place(on, 1).place(off);
    net.transition("down" + std::to_string(i), {on}, {off});
    net.transition("up" + std::to_string(i), {off}, {on});
  }
  EXPECT_EQ(firstFlaw(net), PlanFlaw::kTooLarge);
}

}  // namespace
}  // namespace heel
