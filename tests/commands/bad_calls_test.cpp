// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Help, and calls that can't be understood.

#include "tests/commands/heel.hpp"
#include "tests/support/temp_folder.hpp"

#include <gmock/gmock.h>

#include <regex>

namespace heel::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class Help : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(Help, PrintsAnExample) {
  auto call = GetParam();
  std::string name = "heel";
  for (const std::string& verb : call) name += " " + verb;
  call.emplace_back("--help");
  const HeelRun run = heel(call);
  EXPECT_TRUE(succeeds(run));
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out, HasSubstr("Example"));
  EXPECT_THAT(run.out, HasSubstr("\n  " + name + " ")) << "an example of the verb itself";
}

TEST_P(Help, NamesNoNumberThatMayBeInfinite) {
  // "--cell FLOAT", "--start X,Y", but not "--out TEXT".
  const std::regex number("\n  (--[a-z-]+) (FLOAT|INT|UINT|K:INT|X|X0|LOW|SIZE)\\b");
  const std::string help = heel(GetParam(), {"--help"}).out;
  const bool has_numbers = help.find("--max-memory") != std::string::npos;
  EXPECT_EQ(std::regex_search(help, number), has_numbers);
  for (std::sregex_iterator option(help.begin(), help.end(), number), end; option != end;
       ++option) {
    for (const std::string bad : {"nan", "1e999"}) {
      const HeelRun run = heel(GetParam(), {(*option)[1], bad, bad, bad, bad});
      EXPECT_TRUE(failsWith(run, {(*option)[1]}));
      EXPECT_EQ(run.exit_code, 2);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Verbs, Help,
    testing::Values(std::vector<std::string>{}, std::vector<std::string>{"learn"},
                    std::vector<std::string>{"track"}, std::vector<std::string>{"filter"},
                    std::vector<std::string>{"inspect"}, std::vector<std::string>{"map"},
                    std::vector<std::string>{"plan"}, std::vector<std::string>{"localize"},
                    std::vector<std::string>{"planview"}, std::vector<std::string>{"view"},
                    std::vector<std::string>{"follow"}, std::vector<std::string>{"simulate"},
                    std::vector<std::string>{"evaluate"}, std::vector<std::string>{"experiment"},
                    std::vector<std::string>{"completion"},
                    std::vector<std::string>{"experiment", "detector"},
                    std::vector<std::string>{"experiment", "targets"},
                    std::vector<std::string>{"experiment", "protocol"},
                    std::vector<std::string>{"experiment", "appearance"},
                    std::vector<std::string>{"experiment", "perception"},
                    std::vector<std::string>{"experiment", "gate"},
                    std::vector<std::string>{"experiment", "light"},
                    std::vector<std::string>{"experiment", "follow"},
                    std::vector<std::string>{"experiment", "localization"}));

TEST(Call, WithoutAVerbNamesTheVerbs) {
  EXPECT_TRUE(failsWith(heel({}), {"name a verb", "learn, track, filter", "'heel --help'"}));
  EXPECT_TRUE(failsWith(heel({"experiment"}), {"detector, targets, protocol"}));
}

TEST(Call, OfAnUnknownVerbNamesItAndTheVerbs) {
  EXPECT_TRUE(failsWith(heel({"dance"}), {"'dance'", "learn, track, filter", "'heel --help'"}));
  EXPECT_TRUE(failsWith(heel({"lern"}), {"'lern'; did you mean learn?"}));
}

TEST(Call, ThatTheFileSystemRefusesSaysWhatOfAndWhy) {
  const std::string name(300, 'a');
  EXPECT_TRUE(failsWith(heel({"inspect", name}), {name + " cannot be read: File name too long"}));
}

TEST(Call, WithAnUnknownOptionNamesIt) {
  EXPECT_TRUE(failsWith(heel({"learn", "somewhere", "--colour", "1"}),
                        {"--colour", "'heel learn --help'"}));
  EXPECT_TRUE(failsWith(heel({"track", "somewhere", "--modle", "a.yaml"}),
                        {"no option --modle; did you mean --model?"}))
      << "not that --model is missing";
  EXPECT_TRUE(failsWith(heel({"track", "somewhere", "--modle=a.yaml"}), {"--modle; did you mean"}));
  EXPECT_THAT(heel({"learn", "somewhere", "--qqq", "1"}).err, Not(HasSubstr("did you mean")));
}

TEST(Call, OfHelpWithAVerbIsItsHelp) {
  const HeelRun run = heel({"help", "track"});
  ASSERT_TRUE(succeeds(run));
  EXPECT_EQ(run.out, heel({"track", "--help"}).out);
  EXPECT_THAT(heel({"help"}).out, HasSubstr("a mobile robot follows one person"));
}

TEST(Call, WithAnUnknownSceneOrRobotNamesTheNearest) {
  EXPECT_TRUE(failsWith(heel({"follow", "hom", "--out", "out"}), {"no such scene", "mean home?"}));
  EXPECT_TRUE(failsWith(heel({"config", "turtelbot4"}), {"no such robot", "mean turtlebot4?"}));
  EXPECT_TRUE(failsWith(heel({"config", "xyz"}), {"no such robot", "there are ", "turtlebot4"}));
}

TEST(Call, WithWordsForNumbersSaysSo) {
  for (const char* word : {"abc", "-1", "0"}) {
    EXPECT_TRUE(failsWith(heel({"inspect", "bag", "--to", word}),
                          {"--to: '" + std::string(word) + "' is not a number above 0"}));
  }
}

TEST(Call, WithoutOutWritesNothing) {
  const TempFolder folder;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  for (const std::vector<std::string>& call : {std::vector<std::string>{"learn", "room"},
                                               {"track", "room", "--model", "a.yaml"},
                                               {"planview", "a.pcd"},
                                               {"follow", "home"},
                                               {"map", "home"},
                                               {"simulate", "home"},
                                               {"localize", "log", "--map", "home"},
                                               {"experiment", "follow"}}) {
    EXPECT_TRUE(failsWith(heel(call), {"--out is required"})) << call.front();
  }
  const HeelRun inspected = heel({"inspect", HEEL_SOURCE_DIR "/apps/plans/search.pnml"});
  std::filesystem::current_path(before);
  EXPECT_TRUE(succeeds(inspected));
  EXPECT_THAT(filesBelow(folder.path()), testing::IsEmpty());
}

TEST(Call, WithoutARequiredArgumentNamesIt) {
  EXPECT_TRUE(failsWith(heel({"track", "somewhere"}), {"--model", "'heel track --help'"}));
  EXPECT_TRUE(failsWith(heel({"evaluate", "tracks.csv"}), {"TRUTH"}));
}

TEST(Call, WithTextForANumberNamesBoth) {
  EXPECT_TRUE(failsWith(heel({"learn", "somewhere", "--background", "long"}),
                        {"--background", "long", "'heel learn --help'"}));
}

TEST(Call, WithANumberThatCannotBeNamesIt) {
  for (const std::string bad : {"nan", "1e9", "-1", "inf"}) {
    EXPECT_TRUE(
        failsWith(heel({"planview", "some.pcd", "--out", "o", "--cell", bad}), {"--cell", bad}));
    EXPECT_TRUE(failsWith(heel({"simulate", "home", "--out", "o", "--duration", bad}),
                          {"--duration", bad}));
    EXPECT_TRUE(
        failsWith(heel({"map", "home", "--out", "o", "--resolution", bad}), {"--resolution", bad}));
  }
}

TEST(Call, OfAnUnknownSwitchNamesTheSwitches) {
  EXPECT_TRUE(failsWith(heel({"follow", "home", "--out", "o", "--rough", "people,rain"}),
                        {"'rain'",
                         "people, hurry, company, skirts, drawers, doors, steps, black, glass, "
                         "dropouts, latency, map, laser, light, odometry, and all"}));
  EXPECT_TRUE(
      failsWith(heel({"experiment", "follow", "--out", "o", "--rough", "rain"}), {"'rain'"}));
}

TEST(Call, TellsTheLimitOfMemoryThatItWasGiven) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer's own memory is above the limit";
#endif
  const TempFolder folder;
  writeText(folder / "a.jpg", std::string("\xFF\xD8\xFF\xC0\0\x0B\x08\xFF\xFF\xFF\xFF", 11));
  const auto with = [&](const std::string& limit) {
    return heel({"map", folder / "a.jpg", "--resolution", "1", "--out", folder / "out",
                 "--max-memory", limit});
  };
  EXPECT_TRUE(failsWith(with("2GB"), {"a.jpg: the image of 65535x65535 pixels", "2048 MiB is"}));
  EXPECT_TRUE(failsWith(with("lots"), {"--max-memory"}));
}

TEST(Call, ShowsNoControlCharacters) {
  const TempFolder folder;
  writeText(folder / "a.pcd",
            "VERSION .7\nFIELDS x y z a\x1b[31m\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\n"
            "WIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n1 2 3 4\n");
  const HeelRun run = heel({"inspect", folder / "a.pcd"});
  EXPECT_TRUE(succeeds(run));
  EXPECT_THAT(run.out, HasSubstr("x y z a?[31m"));
  EXPECT_TRUE(failsWith(heel({"inspect", "no\x1b\a"}), {"no??: there is no"}));
}

TEST(Call, TellsItsVersion) {
  const HeelRun run = heel({"--version"});
  EXPECT_TRUE(succeeds(run));
  EXPECT_THAT(run.out, testing::MatchesRegex("heel [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

}  // namespace
}  // namespace heel::test
