// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/apps/simulation/scenes.hpp"
#include "tests/support/temp_folder.hpp"
#include <heel/apps/recording/recording.hpp>
#include <heel/apps/simulation/simulate.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

namespace heel {
namespace {

namespace fs = std::filesystem;

Scene smallScene() {
  Scene scene = test::squareRoom();
  scene.people.push_back(test::standingPerson("eva", 2.0, 0.3));
  return scene;
}

SimulateOptions optionsFor(const fs::path& out, int threads = 0) {
  SimulateOptions options;
  options.out = out;
  options.duration_s = 0.5;
  options.threads = threads;
  return options;
}

TEST(Simulate, WritesARecordingWithItsTruth) {
  const test::TempFolder folder;
  const SimulateResult result = simulate(smallScene(), optionsFor(folder / "out"));
  EXPECT_EQ(result.frames, 5U);
  const fs::path out = folder / "out";
  for (const char* name : {"left/000001.png", "right/000005.png", "truth/depth/000005.png",
                           "truth/people/000001.png", "times.txt", "stereo.yaml", "camera.yaml",
                           "scan.csv", "odometry.csv", "people.csv", "robot.csv"}) {
    EXPECT_TRUE(fs::exists(out / name)) << name;
  }
  EXPECT_EQ(cv::imread((out / "left/000001.png").string()).size(), cv::Size(160, 120));
  EXPECT_EQ(test::readText(out / "times.txt"), "0.000\n0.100\n0.200\n0.300\n0.400\n");
  EXPECT_THAT(test::readText(out / "truth.csv"),
              testing::StartsWith("stamp_s,frame,person,x_m,y_m,exact\n"
                                  "0.000,1,eva,2.0000,0.3000,1\n"));
  const cv::Mat depth = cv::imread((out / "truth/depth/000001.png").string(), cv::IMREAD_UNCHANGED);
  EXPECT_EQ(depth.type(), CV_16UC1);
  EXPECT_EQ(depth.at<std::uint16_t>(20, 140), 29400);  // The wall, 2.94 m away.
}

TEST(Simulate, WritesWhatTheRecordingReadersRead) {
  const test::TempFolder folder;
  const Scene scene = smallScene();
  simulate(scene, optionsFor(folder / "out"));
  const auto recording = openRecording(folder / "out");
  const Simulator simulator(scene, {1, 0, false});
  EXPECT_EQ(recording->info().sensor, SensorKind::kStereo);
  EXPECT_EQ(recording->info().frame_count, 5U);
  EXPECT_NEAR(recording->info().camera.left.fx, simulator.camera().left.fx, 1e-9);
  EXPECT_NEAR(recording->info().camera.baseline_m, simulator.camera().baseline_m, 1e-9);
  ASSERT_TRUE(recording->info().T_base_camera.has_value());
  EXPECT_TRUE(recording->info().T_base_camera->isApprox(simulator.T_base_camera(), 1e-8));
  Frame frame;
  int frames = 0;
  while (recording->next(frame)) {
    EXPECT_NEAR(frame.stamp_s, 0.1 * frames++, 1e-9);
    EXPECT_EQ(frame.right_bgr.size(), cv::Size(160, 120));
  }
  EXPECT_EQ(frames, 5);
  EXPECT_TRUE(recording->skipped().empty());
}

TEST(Simulate, LeavesOutWhoIsNotInView) {
  const test::TempFolder folder;
  Scene scene = test::squareRoom();
  scene.people.push_back(test::standingPerson("eva", -2.0, 0.3));
  simulate(scene, optionsFor(folder / "out"));
  EXPECT_EQ(test::readText(folder / "out/truth.csv"), "stamp_s,frame,person,x_m,y_m,exact\n");
  EXPECT_THAT(test::readText(folder / "out/people.csv"), testing::HasSubstr("eva,-2.0000,0.3000"));
}

TEST(Simulate, WritesTheSameBytesTwice) {
  const test::TempFolder folder;
  simulate(smallScene(), optionsFor(folder / "a", 1));
  simulate(smallScene(), optionsFor(folder / "b", 3));
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder / "a")) {
    // The manifest also says when, and how long it took.
    if (!entry.is_regular_file() || entry.path().filename() == ".heel") continue;
    const fs::path twin = folder / "b" / fs::relative(entry.path(), folder / "a");
    EXPECT_EQ(test::readText(entry.path()), test::readText(twin)) << twin;
    ++files;
  }
  EXPECT_EQ(files, 4 * 5 + 10);
}

TEST(Simulate, DoesNotTouchAFolderThatHoldsSomething) {
  const test::TempFolder folder;
  fs::create_directories(folder / "out");
  folder.write("out/precious.txt", "mine");
  try {
    simulate(smallScene(), optionsFor(folder / "out"));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("out: holds something"));
  }
  EXPECT_EQ(test::readText(folder / "out/precious.txt"), "mine");
}

TEST(Simulate, ReplacesARecordingThatItMade) {
  const test::TempFolder folder;
  simulate(smallScene(), optionsFor(folder / "out"));
  SimulateOptions shorter = optionsFor(folder / "out");
  shorter.duration_s = 0.2;
  simulate(smallScene(), shorter);
  EXPECT_EQ(test::readText(folder / "out/times.txt"), "0.000\n0.100\n");
  EXPECT_FALSE(fs::exists(folder / "out/left/000005.png"));
}

TEST(Simulate, SaysWhichFolderCannotBeMade) {
  const test::TempFolder folder;
  folder.write("file", "not a folder");
  EXPECT_THROW(simulate(smallScene(), optionsFor(folder / "file/out")), std::runtime_error);
}

}  // namespace
}  // namespace heel
