// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What the command may not do to its user's files, and how its runs end.

#include "tests/commands/hall_scene.hpp"
#include "tests/commands/heel.hpp"
#include "tests/commands/small_model.hpp"
#include "tests/commands/small_recording.hpp"
#include "tests/support/temp_folder.hpp"
#include <heel/apps/output/output.hpp>
#include <heel/apps/results/result_files.hpp>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <functional>
#include <regex>

namespace heel::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string kOutputScene =
    hallScene("1", R"({name: "Rosa, the \"first\"", height_m: 1.8, start: [3, -0.5],
     outfit: {top: {color: red}, trousers: {color: charcoal}}, path: [{to: [3, 0.8]}]})",
              "{at: [0.05, 0.06, 1.13], pitch_deg: 5.7, width: 160, height: 120, view_deg: 60}");

class Outputs : public testing::Test {
 protected:
  Outputs() {
    SmallRecording().write(folder_ / "room");
    writeSmallModel(folder_ / "person.yaml");
    writeText(folder_ / "hall.yaml", kOutputScene);
  }

  std::vector<std::string> trackCall(const std::string& out,
                                     const std::vector<std::string>& more = {"--no-film"}) const {
    return joined(
        {"track", folder_ / "room", "--model", folder_ / "person.yaml", "--out", folder_ / out},
        more);
  }
  HeelRun track(const std::string& out,
                const std::vector<std::string>& more = {"--no-film"}) const {
    return heel(trackCall(out, more));
  }
  nlohmann::json summaryOf(const std::string& out) const { return summaryIn(folder_ / out); }

  TempFolder folder_;
};

testing::AssertionResult isRefused(const HeelRun& run, const std::vector<std::string>& parts) {
  if (run.exit_code != 2) return testing::AssertionFailure() << "exit code " << run.exit_code;
  return failsWith(run, parts);
}

TEST_F(Outputs, OfTrackingDoNotReplaceTheRecording) {
  for (const std::string bag : {"rec.bag", "rec_ros2"}) {
    ASSERT_TRUE(succeeds(heel({"simulate", folder_ / "hall.yaml", "--out", folder_ / ("of_" + bag),
                               "--bag", folder_ / bag})));
  }
  const auto before = contentOf(folder_.path());
  for (const std::string recording : {"rec.bag", "rec_ros2"}) {
    EXPECT_TRUE(isRefused(heel({"track", folder_ / recording, "--model", folder_ / "person.yaml",
                                "--out", folder_ / "out", "--bag", folder_ / recording}),
                          {recording, "which is read"}));
  }
  EXPECT_TRUE(isRefused(track("room"), {"room", "which is read"}));
  EXPECT_TRUE(isRefused(track("room/out"), {"room", "which is read"}));
  EXPECT_TRUE(isRefused(track("."), {"which is read"}));
  EXPECT_EQ(contentOf(folder_.path()), before);
}

TEST_F(Outputs, DoNotReplaceAFolderThatHoldsSomebodysMetadata) {
  writeText(folder_ / "album/metadata.yaml", "mine");
  writeText(folder_ / "album/letter.txt", "dear");
  EXPECT_TRUE(isRefused(track("out", {"--no-film", "--bag", folder_ / "album"}), {"album"}));
  EXPECT_THAT(filesBelow(folder_ / "album"), ElementsAre("letter.txt", "metadata.yaml"));
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(Outputs, KeepPicturesThatAreCalledLikeOurs) {
  writeText(folder_ / "out/frame_000003.png", "mine");
  ASSERT_TRUE(succeeds(track("out", {})));
  ASSERT_TRUE(succeeds(track("out")));
  EXPECT_EQ(readText(folder_ / "out/frame_000003.png"), "mine");
  EXPECT_THAT(filesBelow(folder_ / "out"),
              ElementsAre("frame_000003.png", "frames.csv", "report.html", "summary.json",
                          "timing.csv", "tracks.csv"));
}

TEST_F(Outputs, OfMapsDoNotReplaceTheirSource) {
  ASSERT_TRUE(succeeds(heel({"map", folder_ / "hall.yaml", "--out", folder_ / "maps"})));
  const auto before = contentOf(folder_ / "maps");
  EXPECT_TRUE(isRefused(heel({"map", folder_ / "maps/map.yaml", "--out", folder_ / "maps"}),
                        {"which is read"}));
  EXPECT_TRUE(isRefused(heel({"plan", folder_ / "maps/map.png", "--cell", "0.05", "--from", "1,0",
                              "--to", "2,0", "--out", folder_ / "maps"}),
                        {"which is read"}));
  EXPECT_EQ(contentOf(folder_ / "maps"), before);
}

TEST_F(Outputs, OfASimulationLeaveFoldersBesideAlone) {
  writeText(folder_ / "rec.partial/letter.txt", "dear");
  ASSERT_TRUE(succeeds(heel({"simulate", folder_ / "hall.yaml", "--out", folder_ / "rec/"})));
  EXPECT_EQ(readText(folder_ / "rec.partial/letter.txt"), "dear");
  EXPECT_EQ(summaryOf("rec")["complete"], true);
  EXPECT_TRUE(fs::exists(folder_ / "rec/left/000001.png"));
}

TEST_F(Outputs, OfASimulationMayGoToTheFolderInWhichOneStands) {
  fs::create_directories(folder_ / "here");
  const fs::path before = fs::current_path();
  fs::current_path(folder_ / "here");
  const HeelRun run = heel({"simulate", folder_ / "hall.yaml", "--out", "."});
  fs::current_path(before);
  EXPECT_TRUE(succeeds(run));
  EXPECT_TRUE(fs::exists(folder_ / "here/left/000001.png"));
}

TEST_F(Outputs, AreWrittenByOneRunAtATime) {
  const Output other({"track", OutputKind::kFolder, folder_ / "out", {}});
  EXPECT_TRUE(isRefused(track("out"), {"out: another run writes there"}));
}

TEST_F(Outputs, OfPeopleAndFoldersWhoseNamesAreNotUtf8AreWritten) {
  fs::rename(folder_ / "room", folder_ / "caf\xe9");
  EXPECT_TRUE(succeeds(heel({"track", folder_ / "caf\xe9", "--model", folder_ / "person.yaml",
                             "--out", folder_ / "out\xff", "--no-film"})));
  EXPECT_EQ(summaryOf("out\xff")["recording"], "caf\xef\xbf\xbd");
  EXPECT_TRUE(succeeds(heel({"follow", folder_ / "hall.yaml", "--limit", "0.5", "--no-film",
                             "--out", folder_ / "f\xe9"})));
  EXPECT_EQ(summaryOf("f\xe9")["complete"], true);
}

TEST_F(Outputs, OfASimulationHoldNamesWithCommas) {
  ASSERT_TRUE(succeeds(heel({"simulate", folder_ / "hall.yaml", "--out", folder_ / "rec"})));
  const auto truth = readTruth(folder_ / "rec/truth.csv");
  ASSERT_THAT(truth, Not(IsEmpty()));
  EXPECT_EQ(truth.front().person, "Rosa, the \"first\"");
}

TEST_F(Outputs, OfAShortFollowHoldNoNan) {
  const HeelRun run = heel(
      {"follow", folder_ / "hall.yaml", "--limit", "0.5", "--no-film", "--out", folder_ / "out"});
  EXPECT_TRUE(succeeds(run));
  EXPECT_THAT(run.out, Not(HasSubstr("nan")));
  const std::regex no_number("[:,\\[ ]-?(nan|inf)[,\\]}\n]", std::regex::icase);
  for (const char* file : {"summary.json", "follow.csv"}) {
    const std::string text = readText(folder_ / "out" / file);
    EXPECT_FALSE(text.empty()) << file;
    EXPECT_FALSE(std::regex_search(text, no_number)) << file;
  }
}

TEST_F(Outputs, OfAKilledRunAreNoneAndDoNotStopTheNext) {
  ASSERT_TRUE(succeeds(track("out")));
  const auto before = contentOf(folder_ / "out");
  EXPECT_EQ(heelSignalled(trackCall("out", {}), " 10 % ", {SIGKILL}).signal, SIGKILL);
  EXPECT_EQ(contentOf(folder_ / "out"), before);
  ASSERT_TRUE(fs::exists(folder_ / ".out.heel-part"));
  ASSERT_TRUE(succeeds(track("out")));
  EXPECT_FALSE(fs::exists(folder_ / ".out.heel-part"));
}

TEST_F(Outputs, OfAStoppedRunAreWhatWasDoneUntilThen) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const std::string out = "out" + std::to_string(signal);
    const HeelRun run = heelSignalled(trackCall(out, {}), " 10 % ", {signal});
    EXPECT_EQ(run.exit_code, 130);
    EXPECT_THAT(run.errors(), ElementsAre(HasSubstr("heel: stopped")));
    const nlohmann::json summary = summaryOf(out);
    EXPECT_EQ(summary["complete"], false);
    EXPECT_GE(summary["frames"], 6);
    EXPECT_LT(summary["frames"], SmallRecording().frames());
    EXPECT_TRUE(fs::exists(folder_ / out / "tracks.mp4"));
    EXPECT_FALSE(fs::exists(folder_ / ("." + out + ".heel-part")));
  }
}

TEST_F(Outputs, OfAStoppedRunReplaceNoneThatAreComplete) {
  ASSERT_TRUE(succeeds(track("out")));
  const auto before = contentOf(folder_ / "out");
  const HeelRun run = heelSignalled(trackCall("out", {}), " 10 % ", {SIGINT});
  EXPECT_EQ(run.exit_code, 130);
  EXPECT_THAT(run.out, HasSubstr("out.1"));
  EXPECT_EQ(contentOf(folder_ / "out"), before);
  EXPECT_EQ(summaryOf("out.1")["complete"], false);
}

TEST_F(Outputs, OfARunThatASecondSignalEndsAreNone) {
  const HeelRun run = heelSignalled(trackCall("out", {}), " 10 % ", {SIGINT, SIGTERM});
  EXPECT_EQ(run.exit_code, 130);
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(Outputs, OfAStoppedFollowAndSimulationSayThatTheyAreNotComplete) {
  for (const std::string verb : {"follow", "simulate"}) {
    const HeelRun run = heelSignalled(
        {verb, "home", "--out", folder_ / verb, verb == "follow" ? "--limit" : "--duration",
         verb == "follow" ? "100" : "10"},
        " 10 % ", {SIGTERM});
    EXPECT_EQ(run.exit_code, 130) << run.err;
    EXPECT_EQ(summaryOf(verb)["complete"], false);
  }
}

TEST_F(Outputs, OfAStoppedLearningAreNone) {
  const HeelRun run = heelSignalled({"learn", folder_ / "room", "--out", folder_ / "new/p.yaml"},
                                    " 10 % ", {SIGINT});
  EXPECT_EQ(run.exit_code, 130);
  EXPECT_THAT(run.errors(), ElementsAre(HasSubstr("nothing is written")));
  EXPECT_FALSE(fs::exists(folder_ / "new"));
}

TEST_F(Outputs, ExitCodesTellWhyARunEnded) {
  EXPECT_EQ(heel({"--version"}).exit_code, 0);
  EXPECT_EQ(track("out", {"--no-film"}).exit_code, 0);
  EXPECT_EQ(heel(trackCall("full"), 100).exit_code, 1);
  EXPECT_EQ(heel({"map", folder_ / "hall.yaml", "--out", folder_ / "full"}, 100).exit_code, 1);
  EXPECT_EQ(heel({"track"}).exit_code, 2);
  EXPECT_EQ(heel({"fly"}).exit_code, 2);
  EXPECT_EQ(heel({"learn", folder_ / "room", "--out", folder_ / "p.txt"}).exit_code, 2);
  for (const std::string duration : {"nan", "0", "-1", "inf"}) {
    EXPECT_EQ(heel({"simulate", folder_ / "hall.yaml", "--out", folder_ / "rec",
                    "--duration=" + duration})
                  .exit_code,
              2);
  }
  EXPECT_EQ(heel({"track", folder_ / "nowhere", "--model", folder_ / "person.yaml", "--out",
                  folder_ / "o"})
                .exit_code,
            3);
  EXPECT_EQ(heel({"inspect", folder_ / "nowhere"}).exit_code, 3);
  EXPECT_EQ(heel({"plan", folder_ / "hall.yaml", "--from", "1,0", "--to", "99,0", "--out",
                  folder_ / "plan"})
                .exit_code,
            4);
}

}  // namespace
}  // namespace heel::test
