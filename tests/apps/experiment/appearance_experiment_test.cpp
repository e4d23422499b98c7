// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/temp_folder.hpp"
#include <heel/apps/experiment/appearance_experiment.hpp>
#include <heel/apps/experiment/appearance_report.hpp>
#include <heel/apps/experiment/simulated_frames.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace heel {
namespace {

const std::filesystem::path kScenes = std::filesystem::path(HEEL_SOURCE_DIR) / "apps/scenes";

double farthestChannel(const Rgb& a, const Rgb& b) {
  double farthest = 0.0;
  for (int c = 0; c < 3; ++c) {
    farthest = std::max(farthest, std::abs(static_cast<double>(toDisplay(a[c]) - toDisplay(b[c]))));
  }
  return farthest;
}

TEST(RandomWardrobe, IsTheSameForASeedAndAnotherForAnother) {
  const auto top = [](std::uint64_t seed, std::size_t person) {
    return randomWardrobe(seed).people[person].outfit.top.front.color;
  };
  EXPECT_TRUE((top(3, 2) == top(3, 2)).all());
  bool differs = false;
  for (std::size_t i = 0; i < 5; ++i) differs = differs || (top(3, i) != top(4, i)).any();
  EXPECT_TRUE(differs);
}

TEST(RandomWardrobe, HasOnePairInNearlyTheSameTops) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const Wardrobe wardrobe = randomWardrobe(seed);
    ASSERT_EQ(wardrobe.people.size(), 5U);
    const auto colorOf = [&](int i) {
      return wardrobe.people[static_cast<std::size_t>(i)].outfit.top.front.color;
    };
    EXPECT_LE(farthestChannel(colorOf(0), colorOf(1)), 0.2);
    EXPECT_TRUE((colorOf(0) != colorOf(1)).any());
    for (int i = 2; i < 5; ++i) {  // Drawn without putting back.
      for (int j = 0; j < i; ++j) {
        if (j == 1) continue;
        EXPECT_TRUE((colorOf(i) != colorOf(j)).any());
      }
    }
  }
}

AppearanceExperimentParams shortRun() {
  AppearanceExperimentParams params;
  params.empty_s = 2.0;
  params.person_s = 4.0;
  params.trial_s = 2.6;
  params.models = {{"default", AppearanceParams()}};
  params.scenes = kScenes;
  return params;
}

TEST(AppearanceExperiment, TellsCrimsonFromNavyAndWritesItDown) {
  Wardrobe wardrobe = laboratoryWardrobe();
  wardrobe.people = {wardrobe.people[3], wardrobe.people[2]};
  double done = 0.0;
  const WardrobeRuns runs =
      runAppearanceExperiment(wardrobe, shortRun(), [&](double share) { done = share; });
  EXPECT_EQ(done, 1.0);
  const ConfusionMatrix& matrix = runs.models.front().matrix;
  EXPECT_GT(matrix.at(0, 0).frames_in_view, 5);
  EXPECT_GT(matrix.share(0, 0, DetectionRule::kFollowed), 0.5);
  EXPECT_GT(matrix.share(1, 1, DetectionRule::kFollowed), 0.5);
  EXPECT_EQ(matrix.at(0, 1).followed, 0);
  EXPECT_EQ(matrix.identified().count, 2);

  const test::TempFolder folder;
  Output output({"experiment appearance", OutputKind::kFolder, folder.path(), {}});
  writeAppearanceFiles(output, "a", {runs});
  output.commit();
  for (const char* name :
       {"people.csv", "runs.csv", "pairs.csv", "summary.json", "confusion.png"}) {
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "a" / name)) << name;
  }
  const std::string table = test::readText(folder / "a/runs.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 5);  // A header and four runs.
}

/// Three people, and two models that detect as the numbers have it.
WardrobeRuns drawnRuns(std::uint64_t seed) {
  WardrobeRuns runs;
  runs.seed = seed;
  for (const char* model : {"one, with a comma", "another"}) {
    ConfusionMatrix matrix({"anna", "bert", "cleo"});
    for (std::size_t i = 0; i < 9; ++i) {
      const int n = static_cast<int>((seed * 7 + i * 5) % 11);
      matrix.at(i / 3, i % 3) = {20, n, n + 2, 1, 20.0 / (n + 3.0)};
    }
    const PairTest pair = {0, 2, 30, 1.0 / 3.0, 0.25, 12.5, 3.5, 7, 1};
    runs.models.push_back({model, matrix, {pair}});
  }
  runs.acquired = {{"anna", {"#112233", "#000000", "#ffffff", "#aabbcc"}, 40, "enough"}};
  return runs;
}

TEST(AppearanceTables, AreReadAsTheyWereWritten) {
  const test::TempFolder folder;
  Output output({"experiment appearance", OutputKind::kFolder, folder.path(), {}});
  writeAppearanceTables(output, "once", {drawnRuns(4), drawnRuns(5)});
  const auto read = readAppearanceTables((output / "once").written);
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[1].models[1].matrix.at(1, 2).followed,
            drawnRuns(5).models[1].matrix.at(1, 2).followed);
  writeAppearanceTables(output, "twice", read);
  output.commit();
  for (const char* name : {"people.csv", "runs.csv", "pairs.csv"}) {
    EXPECT_EQ(test::readText(folder / "once" / name), test::readText(folder / "twice" / name))
        << name;
  }
}

TEST(AppearanceTables, TellWhichRunsAreMissing) {
  const test::TempFolder folder;
  Output output({"experiment appearance", OutputKind::kFolder, folder.path(), {}});
  writeAppearanceTables(output, "a", {drawnRuns(4)});
  output.commit();
  std::string table = test::readText(folder / "a/runs.csv");
  table.erase(table.rfind('\n', table.size() - 2) + 1);
  test::writeText(folder / "a/runs.csv", table);
  EXPECT_THAT([&] { readAppearanceTables(folder / "a"); },
              testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr(
                  "a/runs.csv: wardrobe 4, another: not everyone's model against everyone")));
}

TEST(WardrobeRooms, HaveTheLightThatIsAskedFor) {
  const ScenePerson person = laboratoryWardrobe().people[0];
  for (const bool drawn : {false, true}) {
    const WardrobeRooms rooms(kScenes, 5, drawn);
    EXPECT_EQ(rooms.acquisition(person, 5.0, 6).robot.camera.drawn_light, drawn);
    EXPECT_EQ(rooms.trial({person}, 6).robot.camera.drawn_light, drawn);
  }
}

TEST(SimulatedFrames, AreTheSameOnEveryRunAndTruthIsInTheBaseFrame) {
  const WardrobeRooms rooms(kScenes, 5);
  const Scene scene = rooms.trial({laboratoryWardrobe().people[0]}, 6);
  SimulatedFramesParams span;
  span.from_s = 2.0;
  span.to_s = 2.4;
  const SimulatedFrames a = renderFrames(scene, span), b = renderFrames(scene, span);
  ASSERT_EQ(a.frames.size(), 2U);
  for (std::size_t i = 0; i < a.frames.size(); ++i) {
    EXPECT_EQ(cv::norm(a.frames[i].frame.image_bgr, b.frames[i].frame.image_bgr, cv::NORM_L1), 0.0);
    ASSERT_TRUE(a.frames[i].people_m[0]);
    EXPECT_GT(a.frames[i].people_m[0]->x(), 0.3);     // Before the robot,
    EXPECT_LT(a.frames[i].people_m[0]->norm(), 5.0);  // and in the room.
  }
}

}  // namespace
}  // namespace heel
