// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// `heel inspect` of a plan.

#include "tests/commands/heel.hpp"
#include "tests/support/temp_folder.hpp"

#include <gmock/gmock.h>

namespace heel::test {
namespace {

using testing::HasSubstr;

std::string shipped(const std::string& name) {
  return std::string(HEEL_SOURCE_DIR) + "/apps/plans/" + name + ".pnml";
}

/// The paper's plan with a part of it exchanged.
std::string changed(const std::string& from, const std::string& to) {
  std::string text = readText(shipped("paper"));
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(InspectPlan, TellsAndDrawsTheShippedPlans) {
  for (const std::string name : {"paper", "search"}) {
    const TempFolder folder;
    const std::string picture = folder / "plan.png";
    const HeelRun run = heel({"inspect", shipped(name), "--out", picture});
    EXPECT_TRUE(succeeds(run));
    EXPECT_THAT(run.out, HasSubstr("goToLastSeen.exec"));
    EXPECT_THAT(run.out, HasSubstr("follow.interrupt face.start [near]"));
    EXPECT_THAT(run.out, HasSubstr("checked: "));
    EXPECT_GT(std::filesystem::file_size(picture), 10000U);
  }
}

TEST(InspectPlan, RefusesABadPlanWithOneSentence) {
  const TempFolder folder;
  const auto refuses = [&](const std::string& text, const std::string& reason) {
    const std::string file = folder.write("plan.pnml", text);
    const std::string picture = folder / "plan.png";
    EXPECT_TRUE(failsWith(heel({"inspect", file, "--out", picture}), {file + ": ", reason}));
    EXPECT_FALSE(std::filesystem::exists(picture));
  };
  refuses("nothing", "this is not XML");
  refuses(changed("seek.exec", "sneak.exec"), "names the action 'sneak', which is unknown");
  refuses(changed("[near]", "[here]"), "the condition 'here' is unknown");
  refuses(changed("<value>goal</value>", "<value>home</value>"), "no place is named 'goal'");
  refuses(changed("target=\"goal\"", "target=\"paris\""), "which is nothing in this net");
}

}  // namespace
}  // namespace heel::test
