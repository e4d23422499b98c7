// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// heel completion, as bash and zsh take it.

#include "tests/commands/heel.hpp"
#include "tests/support/temp_folder.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <sstream>

namespace heel::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::Not;

class Completion : public testing::Test {
 protected:
  Completion() {
    for (const std::string shell : {"bash", "zsh"}) {
      const HeelRun run = heel({"completion", shell});
      EXPECT_TRUE(succeeds(run));
      writeText(folder_ / shell, run.out);
    }
  }

  /// What bash offers where the last of these words is being written.
  std::vector<std::string> offered(const std::vector<std::string>& words) const {
    std::string script = "source " + (folder_ / "bash").string() + "\nCOMP_WORDS=(";
    for (const std::string& word : words) script += "'" + word + "' ";
    script +=
        ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_heel\nprintf '%s\\n' \"${COMPREPLY[@]}\"\n";
    writeText(folder_ / "ask", script);
    const std::string call =
        "bash --norc " + (folder_ / "ask").string() + " > " + (folder_ / "answer").string();
    EXPECT_EQ(std::system(call.c_str()), 0);
    std::istringstream answer(readText(folder_ / "answer"));
    std::vector<std::string> offers;
    for (std::string line; std::getline(answer, line);) {
      if (!line.empty()) offers.push_back(line);
    }
    return offers;
  }

  TempFolder folder_;
};

TEST_F(Completion, OffersVerbs) {
  EXPECT_THAT(offered({"heel", "tr"}), ElementsAre("track"));
  EXPECT_THAT(offered({"heel", ""}), IsSupersetOf({"learn", "experiment", "completion"}));
  EXPECT_THAT(offered({"heel", "experiment", "p"}), ElementsAre("protocol", "perception"));
}

TEST_F(Completion, OffersTheOptionsOfTheVerb) {
  EXPECT_THAT(offered({"heel", "track", "room", "--mo"}), ElementsAre("--model"));
  EXPECT_THAT(offered({"heel", "experiment", "follow", "--"}), Contains("--episodes"));
  EXPECT_THAT(offered({"heel", "experiment", "follow", "--"}), Not(Contains("--model")));
}

TEST_F(Completion, OffersValuesScenesAndPlans) {
  EXPECT_THAT(offered({"heel", "follow", "--light", ""}), ElementsAre("fixed", "drawn"));
  EXPECT_THAT(offered({"heel", "follow", "--light", "=", "d"}), ElementsAre("drawn"));
  EXPECT_THAT(offered({"heel", "follow", "--plan", "s"}), ElementsAre("search"));
  EXPECT_THAT(offered({"heel", "simulate", "ho"}), ElementsAre("home"));
  EXPECT_THAT(offered({"heel", "config", "turt"}), ElementsAre("turtlebot4"));
  EXPECT_THAT(offered({"heel", "simulate", "--drive", "r"}), ElementsAre("roam"));
  EXPECT_THAT(offered({"heel", "localize", "--map-scans", "a"}), ElementsAre("all"));
}

TEST_F(Completion, LeavesFilesToTheShell) {
  EXPECT_THAT(offered({"heel", "learn", "--out", ""}), IsEmpty());
  EXPECT_THAT(offered({"heel", "learn", "rec"}), IsEmpty());
}

TEST_F(Completion, IsGoodZsh) {
  if (std::system("command -v zsh > /dev/null") != 0) GTEST_SKIP() << "there is no zsh";
  EXPECT_EQ(std::system(("zsh -n " + (folder_ / "zsh").string()).c_str()), 0);
}

}  // namespace
}  // namespace heel::test
