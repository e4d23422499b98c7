// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/temp_folder.hpp"
#include <heel/apps/experiment/appearance_experiment.hpp>
#include <heel/apps/experiment/appearance_report.hpp>
#include <heel/apps/experiment/simulated_frames.hpp>

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
    const auto& [a, b] = wardrobe.similar;
    EXPECT_LE(farthestChannel(colorOf(a), colorOf(b)), 0.2);
    EXPECT_TRUE((colorOf(a) != colorOf(b)).any());
    for (int i = 2; i < 5; ++i) {  // Drawn without putting back.
      for (int j = 0; j < i; ++j) {
        if (j == b) continue;
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
  writeAppearanceFiles(output, "a", {runs}, 0.25);
  output.commit();
  for (const char* name :
       {"people.csv", "runs.csv", "pairs.csv", "summary.json", "confusion.png"}) {
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "a" / name)) << name;
  }
  const std::string table = test::readText(folder / "a/runs.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 5);  // A header and four runs.
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
