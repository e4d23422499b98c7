// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// heel capture, from videos: to OpenCV they are the same thing as cameras.

#include "tests/commands/heel.hpp"
#include "tests/support/side_by_side.hpp"
#include "tests/support/temp_folder.hpp"

#include <gmock/gmock.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include <csignal>

namespace heel::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Capture : public testing::Test {
 protected:
  Capture() { writeText(folder_ / "rig.yaml", kSideBySideRig); }

  std::string video(int frames, cv::Size both = {128, 48}) {
    writeSideBySide(folder_ / "video.avi", frames, both);
    return folder_ / "video.avi";
  }

  HeelRun capture(const std::string& from, const std::vector<std::string>& more = {}) {
    return heel({"capture", from, "--out", folder_ / "out"}, more);
  }
  HeelRun captureCalibrated(const std::string& from) {
    return capture(from, {"--calibration", folder_ / "rig.yaml"});
  }
  std::string rigWithItsPlace() {
    writeText(folder_ / "rig/stereo.yaml", kSideBySideRig);
    writeText(folder_ / "rig/camera.yaml", kLevelMounting);
    return folder_ / "rig";
  }
  bool wroteNothing() { return !std::filesystem::exists(folder_ / "out"); }

  TempFolder folder_;
};

TEST_F(Capture, HalvesAVideoIntoARecordingThatTheOtherVerbsRead) {
  const HeelRun run = capture(video(12), {"--calibration", rigWithItsPlace()});
  ASSERT_TRUE(succeeds(run));
  EXPECT_THAT(run.out, HasSubstr("12 pairs of 64x48 over 1.1 s"));
  EXPECT_THAT(run.warnings(), IsEmpty());
  const cv::Mat left = cv::imread(folder_ / "out/left/000005.png");
  const cv::Mat right = cv::imread(folder_ / "out/right/000005.png");
  ASSERT_EQ(left.size(), cv::Size(64, 48));
  EXPECT_NEAR(cv::mean(left)[0], 54, 1.5);
  EXPECT_NEAR(cv::mean(right)[0], 154, 1.5);
  const HeelRun inspected = heel({"inspect", folder_ / "out", "--out", folder_ / "out.png"});
  EXPECT_TRUE(succeeds(inspected));
  EXPECT_THAT(inspected.out, HasSubstr("12 frames over 1.1 s"));
  EXPECT_THAT(inspected.out, HasSubstr("baseline 0.120 m"));
}

TEST_F(Capture, TakesACalibrationsFolderWithTheCamerasPlace) {
  const std::string rig = rigWithItsPlace();
  writeText(folder_ / "rig/letter.odt", "dear");
  writeText(folder_ / "rig/summary.json", "{}");
  ASSERT_TRUE(succeeds(capture(video(3), {"--calibration", rig})));
  EXPECT_THAT(filesBelow(folder_ / "out"),
              ElementsAre("camera.yaml", "left/000001.png", "left/000002.png", "left/000003.png",
                          "right/000001.png", "right/000002.png", "right/000003.png", "stereo.yaml",
                          "times.txt"));
}

TEST_F(Capture, EndsAfterTheTimeThatItIsGiven) {
  const HeelRun run = capture(video(30), {"--duration", "0.5"});
  ASSERT_TRUE(succeeds(run));
  EXPECT_THAT(run.out, HasSubstr("6 pairs of 64x48 over 0.5 s"));
  EXPECT_THAT(run.warnings(), ElementsAre(HasSubstr("calibration")));
}

TEST_F(Capture, RefusesWhatItCantRecord) {
  EXPECT_TRUE(failsWith(capture("4711"), {"/dev/video4711", "no such camera"}));
  EXPECT_TRUE(failsWith(capture(folder_ / "rig.yaml"), {"rig.yaml", "no camera or video"}));
  EXPECT_TRUE(failsWith(captureCalibrated(video(3, {96, 48})),
                        {"rig.yaml", "of images of 64x48, and these are of 48x48"}));
  cv::imwrite(folder_ / "odd.png", cv::Mat(48, 127, CV_8UC3, cv::Scalar::all(9)));
  EXPECT_TRUE(failsWith(capture(folder_ / "odd.png"), {"odd.png", "127 pixels wide"}));
  writeText(folder_ / "rig.yaml", "nothing: 1\n");
  EXPECT_TRUE(failsWith(captureCalibrated(video(3)), {"rig.yaml"}));
  EXPECT_TRUE(wroteNothing());
}

#ifndef HEEL_HAS_OPENNI
TEST_F(Capture, SaysHowToGetDepthCameras) {
  EXPECT_TRUE(failsWith(capture("openni"), {"openni", "without OpenNI2", "libopenni2-dev"}));
}
#endif

TEST_F(Capture, LeavesAFolderThatHoldsSomething) {
  writeText(folder_ / "out/letter.txt", "dear");
  EXPECT_TRUE(failsWith(capture(video(3)), {"out"}));
  EXPECT_THAT(filesBelow(folder_ / "out"), ElementsAre("letter.txt"));
}

TEST_F(Capture, KeepsWhatItHasWhenItIsStopped) {
  const std::string file = video(3000);
  const HeelRun run =
      heelSignalled({"capture", file, "--out", folder_ / "out"}, "capturing: 10 %", {SIGINT});
  ASSERT_TRUE(succeeds(run));
  EXPECT_THAT(filesBelow(folder_ / "out"), testing::Contains("times.txt"));
  EXPECT_THAT(run.out, testing::Not(HasSubstr("3000 pairs")));
}

}  // namespace
}  // namespace heel::test
