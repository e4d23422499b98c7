// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The main road on a folder of PCD files.

#include "tests/commands/heel.hpp"
#include "tests/commands/small_recording.hpp"
#include "tests/support/temp_folder.hpp"
#include <heel/apps/recording/clouds/cloud_file.hpp>
#include <heel/apps/recording/recording.hpp>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <pcl/conversions.h>

#include <cstdio>

namespace heel::test {
namespace {

using testing::HasSubstr;

/// Stores a recording's frames as organized clouds, with its times.
void writeAsClouds(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::filesystem::create_directories(to);
  const auto recording = openRecording(from);
  std::string times;
  Frame frame;
  while (recording->next(frame)) {
    CloudFile file;
    makeColorCloud(frame.depth_m, frame.image_bgr, recording->info().camera.left,
                   Eigen::Isometry3d::Identity(), file.cloud);
    pcl::toPCLPointCloud2(file.cloud, file.blob);
    writeCloud(to / (std::to_string(frame.number) + ".pcd"), file);
    times += std::to_string(frame.stamp_s) + "\n";
  }
  writeText(to / "times.txt", times);
}

TEST(LearnFromClouds, FollowsThePersonAsInImages) {
  const TempFolder folder;
  SmallRecording().write(folder / "room");
  writeAsClouds(folder / "room", folder / "clouds");
  ASSERT_TRUE(succeeds(heel({"learn", folder / "clouds", "--out", folder / "rosa.yaml"})));
  ASSERT_TRUE(succeeds(heel({"track", folder / "clouds", "--model", folder / "rosa.yaml",
                             "--no-film", "--out", folder / "out"})));
  ASSERT_TRUE(succeeds(heel({"evaluate", folder / "out/tracks.csv", folder / "room/truth.csv",
                             "--out", folder / "figures.json"})));
  const auto figures = nlohmann::json::parse(readText(folder / "figures.json"));
  EXPECT_GE(figures["target"]["recall"], 0.9);

  const HeelRun inspected = heel({"inspect", folder / "clouds", "--out", folder / "clouds.png"});
  EXPECT_TRUE(succeeds(inspected));
  EXPECT_THAT(inspected.out, HasSubstr("66 x PCD binary_compressed, organized, colour in rgb"));
  EXPECT_THAT(inspected.out, HasSubstr("66 frames over 13.0 s"));
  EXPECT_THAT(inspected.out, HasSubstr("camera 1.0"));
}

}  // namespace
}  // namespace heel::test
