// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/planning/small_net.hpp"
#include "tests/support/temp_folder.hpp"
#include <heel/planning/plan_file.hpp>

#include <gtest/gtest.h>

namespace heel {
namespace {

using test::SmallNet;

const PlanVocabulary kFileWords = {{"walk"}, {"near"}};

/// The error for a plan of one transition, from a place that has a token to another.
std::string error(const std::string& from, const std::string& transition, const std::string& to) {
  const test::TempFolder folder;
  const PetriNet net = SmallNet().place(from, 1).place(to).transition(transition, {from}, {to});
  const auto file = folder.write("plan.pnml", toPnml(net));
  const std::string message = test::messageOf([&] { loadPlan(file, kFileWords); });
  const std::string start = file.string() + ": ";
  EXPECT_TRUE(message.empty() || message.rfind(start, 0) == 0) << message;
  return message.substr(std::min(start.size(), message.size()));
}

TEST(PlanFile, LoadsASoundPlan) {
  EXPECT_EQ(error("walk.exec", "walk.end [near]", "goal"), "");
  EXPECT_EQ(error("walk.exec", "enough walk.end   [not near]", "the goal"), "");
}

TEST(PlanFile, NamesWhatIsUnknown) {
  EXPECT_EQ(error("fly.exec", "fly.end [near]", "goal"),
            "place 'fly.exec' (fly.exec) names the action 'fly', which is unknown");
  EXPECT_EQ(
      error("walk.exec", "fly.end [near]", "goal"),
      "transition 'fly.end [near]' (fly.end [near]) names the action 'fly', which is unknown");
  EXPECT_EQ(error("walk.exec", "walk.end [far]", "goal"),
            "transition 'walk.end [far]' (walk.end [far]) has the guard [far], in which the "
            "condition 'far' is unknown");
  EXPECT_EQ(error("walk.exec", "walk.halt [near]", "goal"),
            "transition 'walk.halt [near]' (walk.halt [near]) names the event 'halt', which is "
            "unknown");
}

TEST(PlanFile, AnEndWithoutAGuardWaitsForTheAction) {
  EXPECT_EQ(
      error("walk.exec", "walk.end", "goal"),
      "transition 'walk.end' (walk.end) has the guard [walk.finished], in which the condition "
      "'walk.finished' is unknown");
}

TEST(PlanFile, AJoinWithoutAGuardWaitsForAllItsActions) {
  const PlanVocabulary words = {{"walk", "wave"}, {"walk.finished", "wave.failed"}};
  const PetriPlan plan =
      makePlan(SmallNet()
                   .place("walk.exec", 1)
                   .place("wave.exec", 1)
                   .place("goal")
                   .transition("walk.end wave.fail", {"walk.exec", "wave.exec"}, {"goal"}),
               words);
  const PlanGuard& guard = plan.transitions.front().guard;
  EXPECT_FALSE(guard.holds({1, 0}));
  EXPECT_FALSE(guard.holds({0, 1}));
  EXPECT_TRUE(guard.holds({1, 1}));
}

TEST(PlanFile, NamesWhatMakesNoSense) {
  EXPECT_EQ(error("walk.exec walk.exec", "walk.end [near]", "goal"),
            "place 'walk.exec walk.exec' (walk.exec walk.exec) names two actions");
  EXPECT_EQ(error("begin", "[near", "goal"),
            "transition '[near' ([near) has a guard that does not close");
  EXPECT_EQ(error("begin", "[near] [near]", "goal"),
            "transition '[near] [near]' ([near] [near]) has two guards");
  EXPECT_EQ(error("begin", "go", "goal(many)"),
            "place 'goal(many)' (goal(many)) asks for 'goal(many)', which is no number of tokens");
}

TEST(PlanFile, TellsTheFirstFaultOfAPlan) {
  EXPECT_EQ(error("begin", "go", "nowhere"), "no place is named 'goal'");
}

}  // namespace
}  // namespace heel
