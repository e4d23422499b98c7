// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The main road: learn somebody, follow them, compare with the truth.

#include "tests/commands/heel.hpp"
#include "tests/commands/small_model.hpp"
#include "tests/commands/small_recording.hpp"
#include "tests/support/temp_folder.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace heel::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;

class LearnAndTrack : public testing::Test {
 protected:
  void learn(const std::string& out, const std::vector<std::string>& options = {}) {
    const HeelRun run = heel({"learn", folder_ / "room", "--out", folder_ / out}, options);
    ASSERT_TRUE(succeeds(run));
    EXPECT_THAT(run.out, HasSubstr("wrote "));
  }

  HeelRun track(const std::string& model, const std::string& out,
                const std::vector<std::string>& more = {}) {
    std::vector<std::string> words = {"track",         folder_ / "room", "--model",
                                      folder_ / model, "--out",          folder_ / out};
    words.insert(words.end(), more.begin(), more.end());
    return heel(words);
  }

  nlohmann::json evaluate(const std::string& tracks) {
    EXPECT_TRUE(succeeds(
        heel({"evaluate", folder_ / tracks, folder_ / "room", "--out", folder_ / "figures.json"})));
    return nlohmann::json::parse(readText(folder_ / "figures.json"));
  }

  TempFolder folder_;
};

TEST_F(LearnAndTrack, FollowsThePersonWhoWasLearned) {
  SmallRecording().write(folder_ / "room");
  learn("models/rosa.yaml");
  EXPECT_THAT(filesBelow(folder_ / "models"),
              ElementsAre("rosa.png", "rosa.yaml", "rosa_view.png"));
  const HeelRun run = track("models/rosa.yaml", "out");
  ASSERT_TRUE(succeeds(run));
  EXPECT_THAT(run.warnings(), ElementsAre());
  EXPECT_THAT(run.out, HasSubstr("tracks.mp4"));
  const auto files = filesBelow(folder_ / "out");
  EXPECT_THAT(files, IsSupersetOf({"frames.csv", "report.html", "summary.json", "timing.csv",
                                   "tracks.csv", "tracks.mp4"}));
  EXPECT_THAT(files, Contains(testing::MatchesRegex("frame_[0-9]+\\.png")).Times(testing::Ge(3)));
  const auto figures = evaluate("out/tracks.csv");
  EXPECT_EQ(figures["target"]["name"], "rosa");
  EXPECT_EQ(figures["target"]["frames_in_view"], 40);
  EXPECT_GE(figures["target"]["recall"], 0.9);
  EXPECT_EQ(figures["target"]["wrong_person_share"], 0.0);
  // The side of a body that is seen is up to 0.15 m nearer than its middle.
  EXPECT_LT(figures["target"]["mean_error_m"], 0.15);
}

TEST_F(LearnAndTrack, APartIsJudgedByItsOwnFrames) {
  SmallRecording().write(folder_ / "room");
  writeSmallModel(folder_ / "rosa.yaml");
  ASSERT_TRUE(succeeds(track("rosa.yaml", "out", {"--from", "8", "--no-film"})));
  const auto figures = evaluate("out");
  EXPECT_LT(figures["target"]["frames_in_view"], 40);
  EXPECT_GE(figures["target"]["recall"], 0.85);
}

TEST_F(LearnAndTrack, WarnsOfTooLittleToLearnFrom) {
  SmallRecording{26, 3}.write(folder_ / "room");
  const HeelRun run = heel({"learn", folder_ / "room", "--out", folder_ / "rosa.yaml"});
  ASSERT_TRUE(succeeds(run));
  EXPECT_THAT(run.warnings(), Contains(HasSubstr("rosa_view.png, whether it is the person")));
}

TEST_F(LearnAndTrack, FindsThePlaceOfTheCameraByTheFloor) {
  SmallRecording recording;
  recording.has_mounting = false;
  recording.write(folder_ / "room");
  learn("rosa.yaml");
  ASSERT_TRUE(succeeds(track("rosa.yaml", "out")));
  const auto summary = summaryIn(folder_ / "out");
  EXPECT_EQ(summary["camera"]["from"], "floor");
  EXPECT_NEAR(summary["camera"]["height_m"], 1.0, 0.02);
  EXPECT_GE(evaluate("out")["target"]["recall"], 0.9);
}

TEST_F(LearnAndTrack, LearnsThePapersModelToo) {
  SmallRecording().write(folder_ / "room");
  learn("rosa.yaml", {"--paper", "1"});
  ASSERT_TRUE(succeeds(track("rosa.yaml", "out")));
  EXPECT_GE(evaluate("out/tracks.csv")["target"]["recall"], 0.9);
}

TEST_F(LearnAndTrack, GivesTheSameBytesOnEveryRun) {
  SmallRecording().write(folder_ / "room");
  for (const char* run : {"1", "2"}) {
    learn(std::string("models") + run + "/rosa.yaml");
    ASSERT_TRUE(succeeds(track("models1/rosa.yaml", std::string("out") + run)));
  }
  for (const char* folder : {"models", "out"}) {
    const auto first = folder_ / (std::string(folder) + "1");
    const auto second = folder_ / (std::string(folder) + "2");
    const auto files = filesBelow(first);
    EXPECT_EQ(filesBelow(second), files);
    EXPECT_GE(files.size(), 3U);
    for (const std::string& file : files) {
      if (file == "timing.csv" || file == "tracks.mp4") continue;
      EXPECT_TRUE(readText(first / file) == readText(second / file)) << file << " differs";
    }
  }
}

TEST_F(LearnAndTrack, LeavesNoPictureOfAFormerRunBesideNewTables) {
  SmallRecording{3, 6}.write(folder_ / "room");
  writeSmallModel(folder_ / "rosa.yaml");
  ASSERT_TRUE(succeeds(track("rosa.yaml", "out")));
  EXPECT_GT(filesBelow(folder_ / "out").size(), 5U);
  ASSERT_TRUE(succeeds(track("rosa.yaml", "out", {"--no-film"})));
  EXPECT_THAT(filesBelow(folder_ / "out"),
              testing::UnorderedElementsAre("report.html", "tracks.csv", "frames.csv", "timing.csv",
                                            "summary.json"));
}

TEST_F(LearnAndTrack, TakesPlacesWithCommasOrBlanks) {
  SmallRecording{3, 6}.write(folder_ / "room");
  writeSmallModel(folder_ / "rosa.yaml");
  ASSERT_TRUE(
      succeeds(track("rosa.yaml", "a", {"--no-film", "--start", "2,0", "--bounds", "0,-2,4,2"})));
  ASSERT_TRUE(succeeds(track("rosa.yaml", "b",
                             {"--no-film", "--start", "2", "0", "--bounds", "0", "-2", "4", "2"})));
  EXPECT_EQ(readText(folder_ / "a/tracks.csv"), readText(folder_ / "b/tracks.csv"));
}

TEST_F(LearnAndTrack, SaysWhatEveryStageLeftOfEveryFrame) {
  const SmallRecording recording{3, 6};
  recording.write(folder_ / "room");
  writeSmallModel(folder_ / "rosa.yaml");
  ASSERT_TRUE(succeeds(track("rosa.yaml", "out")));
  std::istringstream frames(readText(folder_ / "out/frames.csv"));
  std::vector<std::string> lines;
  for (std::string line; std::getline(frames, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 1U + static_cast<std::size_t>(recording.frames()));
  EXPECT_EQ(lines[0],
            "frame,stamp_s,color_pixels,color_points,standing_points,blobs,observations,tracks,"
            "target_id,confidence,state,reason,robot_x_m,robot_y_m,robot_yaw_rad");
  EXPECT_THAT(lines[1], HasSubstr(",no pixel has the target's colours,"));
  EXPECT_THAT(lines[9], HasSubstr(",followed,,")) << "the target is there";
  std::istringstream tracks(readText(folder_ / "out/tracks.csv"));
  std::string header;
  std::getline(tracks, header);
  EXPECT_EQ(header,
            "stamp_s,track_id,is_target,x_m,y_m,vx_mps,vy_mps,score,status,"
            "person_probability");
}

TEST_F(LearnAndTrack, TracksNobodyInAnEmptyRoom) {
  SmallRecording{12, 0}.write(folder_ / "room");
  writeSmallModel(folder_ / "rosa.yaml");
  const HeelRun run = track("rosa.yaml", "out");
  ASSERT_TRUE(findsNothing(run));
  EXPECT_THAT(run.err, HasSubstr("mostly, no pixel has the target's colours; a person in other"));
  const auto summary = summaryIn(folder_ / "out");
  EXPECT_EQ(summary["frames"], 12);
  EXPECT_EQ(summary["frames_with_target"], 0);
  EXPECT_EQ(summary["frames_by_reason"]["no pixel has the target's colours"], 12);
}

TEST_F(LearnAndTrack, LearnsNobodyWhereNobodyEnters) {
  SmallRecording{32, 0}.write(folder_ / "room");
  const HeelRun run = heel({"learn", folder_ / "room", "--out", folder_ / "out/rosa.yaml"});
  EXPECT_TRUE(failsWith(run, {"room", "nobody entered"}));
  EXPECT_TRUE(findsNothing(run));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(LearnAndTrack, SaysThatTheRoomWasNotEmptyAtFirst) {
  SmallRecording{32, 60}.write(folder_ / "room");
  const auto from = [&](const char* begin_s) {
    return heel({"learn", folder_ / "room", "--from", begin_s, "--out", folder_ / "rosa.yaml"});
  };
  EXPECT_THAT(from("6.4").err, HasSubstr("something moved in the first seconds"));
  const HeelRun short_lesson = from("3");
  EXPECT_TRUE(succeeds(short_lesson));
  EXPECT_THAT(short_lesson.err, Not(HasSubstr("something moved")));
  EXPECT_THAT(short_lesson.out, HasSubstr(" 17 frames of the empty room"));
}

TEST_F(LearnAndTrack, RefusesANameThatIsNoModels) {
  SmallRecording{1, 0}.write(folder_ / "room");
  EXPECT_TRUE(failsWith(heel({"learn", folder_ / "room", "--out", folder_ / "rosa.png"}),
                        {"rosa.png", ".yaml"}));
}

TEST_F(LearnAndTrack, InspectTellsOfModelAndRecording) {
  SmallRecording{6, 0}.write(folder_ / "room");
  writeSmallModel(folder_ / "rosa.yaml");
  const HeelRun model = heel({"inspect", folder_ / "rosa.yaml", "--out", folder_ / "rosa.png"});
  EXPECT_TRUE(succeeds(model));
  EXPECT_THAT(model.out, HasSubstr("expected false positives"));
  const HeelRun room = heel({"inspect", folder_ / "room", "--out", folder_ / "room.png"});
  EXPECT_TRUE(succeeds(room));
  EXPECT_THAT(room.out, HasSubstr("6 frames over 1.0 s"));
  EXPECT_THAT(room.out, HasSubstr("camera 1.00 m over the floor"));
  EXPECT_THAT(filesBelow(folder_.path()), IsSupersetOf({"room.png", "rosa.png"}));
}

TEST_F(LearnAndTrack, EvaluateNamesTheLineThatIsWrong) {
  writeText(folder_ / "tracks.csv",
            "stamp_s,track_id,is_target,x_m,y_m,vx_mps,vy_mps,score,status\n0,1,1,a,0,0,0,0,x\n");
  writeText(folder_ / "truth.csv", "stamp_s,frame,person,x_m,y_m,exact\n0,1,rosa,1,1,1\n");
  EXPECT_TRUE(failsWith(heel({"evaluate", folder_ / "tracks.csv", folder_ / "truth.csv"}),
                        {"tracks.csv", "line 2", "x_m"}));
  EXPECT_TRUE(failsWith(heel({"evaluate", folder_ / "none.csv", folder_ / "truth.csv"}),
                        {"none.csv", "cannot be read"}));
}

}  // namespace
}  // namespace heel::test
