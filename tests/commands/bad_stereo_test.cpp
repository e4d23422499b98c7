// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Stereo recordings whose set-up is wrong.

#include "tests/commands/heel.hpp"
#include "tests/commands/small_model.hpp"
#include "tests/support/stereo_scene.hpp"
#include "tests/support/temp_folder.hpp"

#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>

namespace heel::test {
namespace {

/// Two frames of a drawn room, whose calibration is written by each test.
class StereoFolder : public testing::Test {
 protected:
  void write(const std::string& left, const std::string& right, double baseline_m) {
    const StereoScene scene = render(roomWithPerson(), {640, 480});
    for (const char* name : {"left", "right"}) {
      std::filesystem::create_directories(folder_ / "room" / name);
    }
    for (const char* name : {"1.png", "2.png"}) {
      cv::imwrite(folder_.path() / "room" / left / name, scene.left);
      cv::imwrite(folder_.path() / "room" / right / name, scene.right);
    }
    const std::string P = "!!opencv-matrix\n  rows: 3\n  cols: 4\n  dt: d\n  data: [500, 0, 320, ";
    writeText(folder_ / "room/calib.yaml",
              "%YAML:1.0\n---\nimage_width: 640\nimage_height: 480\nP1: " + P +
                  "0, 0, 500, 240, 0, 0, 0, 1, 0]\nP2: " + P + std::to_string(-500.0 * baseline_m) +
                  ", 0, 500, 240, 0, 0, 0, 1, 0]\n");
    writeText(folder_ / "room/camera.yaml",
              "T_ground_camera: [0,0,1,0, -1,0,0,0, 0,-1,0,1, 0,0,0,1]\n");
    writeSmallModel(folder_ / "person.yaml");
  }

  void expectAllFail(const std::vector<std::string>& parts) {
    EXPECT_TRUE(failsWith(heel({"track", folder_ / "room", "--model", folder_ / "person.yaml",
                                "--out", folder_ / "out"}),
                          parts));
    EXPECT_TRUE(
        failsWith(heel({"learn", folder_ / "room", "--out", folder_ / "out/model.yaml"}), parts));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
  }

  TempFolder folder_;
};

TEST_F(StereoFolder, WithSwappedImagesSaysSo) {
  write("right", "left", 0.1);
  expectAllFail({"room", "left and right images are swapped", "negative"});
}

TEST_F(StereoFolder, WithoutBaselineSaysSo) {
  write("left", "right", 0.0);
  expectAllFail({"calib.yaml", "no baseline"});
}

TEST_F(StereoFolder, WithSwappedCamerasSaysSo) {
  write("left", "right", -0.1);
  expectAllFail({"calib.yaml", "swapped", "negative"});
}

TEST_F(StereoFolder, WithoutCalibrationSaysWhatToWrite) {
  write("left", "right", 0.1);
  std::filesystem::remove(folder_ / "room/calib.yaml");
  expectAllFail({"room", "no calibration", "calib.yaml"});
}

TEST_F(StereoFolder, GoesOnWithoutARightImageThatIsMissing) {
  write("left", "right", 0.1);
  std::filesystem::remove(folder_ / "room/right/2.png");
  const HeelRun run = heel({"track", folder_ / "room", "--model", folder_ / "person.yaml", "--out",
                            folder_ / "out", "--no-film"});
  EXPECT_TRUE(findsNothing(run));
  EXPECT_THAT(run.warnings(), testing::Contains(testing::HasSubstr("the right image")));
  EXPECT_THAT(run.out, testing::HasSubstr("1 frame was left out"));
}

}  // namespace
}  // namespace heel::test
