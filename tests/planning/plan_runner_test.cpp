// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/planning/small_net.hpp"
#include "tests/support/allocation_count.hpp"
#include <heel/planning/plan_runner.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

namespace heel {
namespace {

using test::SmallNet;
using testing::ElementsAre;
using testing::IsEmpty;

enum Action { kWalk, kWave };
enum Condition { kNear, kTired };
const PlanVocabulary kRunnerWords = {{"walk", "wave"}, {"near", "tired"}};

PlanRunner runnerOf(const PetriNet& net) { return PlanRunner(makePlan(net, kRunnerWords)); }

/// Steps while exactly these conditions hold.
PlanStep step(PlanRunner& runner, const std::set<int>& facts = {}) {
  return runner.step([&](int condition) { return facts.count(condition) > 0; });
}

SmallNet walkAndWave() {
  return SmallNet()
      .place("begin", 1)
      .place("walk.exec")
      .place("wave.exec")
      .place("goal")
      .place("fail")
      .transition("walk.start", {"begin"}, {"walk.exec"})
      .transition("walk.interrupt wave.start [near]", {"walk.exec"}, {"wave.exec"})
      .transition("walk.fail [tired]", {"walk.exec"}, {"fail"})
      .transition("wave.end [tired]", {"wave.exec"}, {"goal"});
}

TEST(PlanRunner, StartsAndRunsAnAction) {
  PlanRunner runner = runnerOf(walkAndWave());
  EXPECT_THAT(runner.last().active, IsEmpty());
  EXPECT_THAT(step(runner).started, ElementsAre(kWalk));
  EXPECT_THAT(runner.last().active, ElementsAre(kWalk));
  EXPECT_THAT(step(runner).started, IsEmpty());
  EXPECT_THAT(runner.last().active, ElementsAre(kWalk));
}

TEST(PlanRunner, AnInterruptEndsItsAction) {
  PlanRunner runner = runnerOf(walkAndWave());
  step(runner);
  const PlanStep last = step(runner, {kNear});
  EXPECT_THAT(last.started, ElementsAre(kWave));
  EXPECT_THAT(last.active, ElementsAre(kWave));
  EXPECT_THAT(last.ended, IsEmpty());
}

TEST(PlanRunner, TheFirstTransitionInTheFileGetsTheToken) {
  PlanRunner runner = runnerOf(walkAndWave());
  step(runner);
  EXPECT_THAT(step(runner, {kNear, kTired}).active, ElementsAre(kWave));
}

TEST(PlanRunner, WhatStartsInAStepIsNotEndedInIt) {
  PlanRunner runner = runnerOf(walkAndWave());
  EXPECT_THAT(step(runner, {kNear, kTired}).active, ElementsAre(kWalk));
  EXPECT_THAT(step(runner, {kNear, kTired}).active, ElementsAre(kWave));
  EXPECT_EQ(step(runner, {kNear, kTired}).outcome, PlanOutcome::kReached);
}

TEST(PlanRunner, ReachesItsGoalOnce) {
  PlanRunner runner = runnerOf(walkAndWave());
  step(runner);
  step(runner, {kNear});
  EXPECT_EQ(step(runner, {kTired}).outcome, PlanOutcome::kReached);
  EXPECT_THAT(runner.last().ended, ElementsAre(kWave));
  EXPECT_THAT(runner.last().active, IsEmpty());
  EXPECT_THAT(step(runner, {kTired}).ended, IsEmpty());
  EXPECT_EQ(runner.last().outcome, PlanOutcome::kReached);
}

TEST(PlanRunner, Fails) {
  PlanRunner runner = runnerOf(walkAndWave());
  step(runner);
  EXPECT_EQ(step(runner, {kTired}).outcome, PlanOutcome::kFailed);
  EXPECT_THAT(runner.last().ended, ElementsAre(kWalk));
}

TEST(PlanRunner, TransitionsThatShareNoTokenFireTogether) {
  PlanRunner runner = runnerOf(SmallNet()
                                   .place("a", 1)
                                   .place("b", 1)
                                   .place("walk.exec")
                                   .place("wave.exec")
                                   .transition("walk.start", {"a"}, {"walk.exec"})
                                   .transition("wave.start", {"b"}, {"wave.exec"}));
  EXPECT_THAT(step(runner).active, ElementsAre(kWalk, kWave));
}

TEST(PlanRunner, TheEndOfThePlanEndsWhatRunsBesideIt) {
  PlanRunner runner = runnerOf(SmallNet()
                                   .place("a", 1)
                                   .place("wave.exec", 1)
                                   .place("goal")
                                   .transition("[near]", {"a"}, {"goal"}));
  EXPECT_THAT(runner.last().active, ElementsAre(kWave));
  EXPECT_THAT(step(runner, {kNear}).ended, ElementsAre(kWave));
  EXPECT_THAT(runner.last().active, IsEmpty());
}

TEST(PlanRunner, AGoalOfSeveralPlacesNeedsThemAll) {
  PlanRunner runner = runnerOf(SmallNet()
                                   .place("a", 1)
                                   .place("b", 2)
                                   .place("goal")
                                   .place("goal(2)")
                                   .transition("[near]", {"a"}, {"goal"})
                                   .transition("[tired]", {"b"}, {"goal(2)"}));
  EXPECT_EQ(step(runner, {kNear, kTired}).outcome, PlanOutcome::kRunning);
  EXPECT_EQ(step(runner, {kTired}).outcome, PlanOutcome::kReached);
}

TEST(PlanRunner, StartsAgain) {
  PlanRunner runner = runnerOf(walkAndWave());
  step(runner);
  step(runner, {kTired});
  runner.reset();
  EXPECT_EQ(runner.last().outcome, PlanOutcome::kRunning);
  EXPECT_THAT(step(runner).started, ElementsAre(kWalk));
}

TEST(PlanRunner, AStepAllocatesNothing) {
  PlanRunner runner = runnerOf(walkAndWave());
  const long before = test::allocations();
  for (int i = 0; i < 100; ++i) {
    runner.step([&](int condition) { return i % 3 == condition; });
    if (i % 10 == 0) runner.step([](int) { return true; });
  }
  EXPECT_EQ(test::allocations(), before);
}

TEST(PlanRunner, NeedsARoleForEachElement) {
  PetriPlan plan = makePlan(walkAndWave(), kRunnerWords);
  plan.places.pop_back();
  EXPECT_THROW(PlanRunner{plan}, std::invalid_argument);
}

}  // namespace
}  // namespace heel
