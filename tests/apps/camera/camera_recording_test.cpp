// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/side_by_side.hpp"
#include "tests/support/temp_folder.hpp"
#include <heel/apps/camera/camera_recording.hpp>

#include <gmock/gmock.h>
#include <opencv2/core.hpp>

#include <chrono>
#include <stdexcept>

namespace heel::test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

class CameraRecordingTest : public testing::Test {
 protected:
  CameraRecordingTest() {
    writeText(folder_ / "stereo.yaml", kSideBySideRig);
    writeText(folder_ / "camera.yaml", kLevelMounting);
    writeSideBySide(folder_ / "video.avi", 4);
    params_.device = folder_ / "video.avi";
    params_.calibration = folder_.path();
  }

  TempFolder folder_;
  PairCameraParams params_;
};

TEST_F(CameraRecordingTest, GivesThePairsOfAVideoInRealTime) {
  const auto began = std::chrono::steady_clock::now();
  CameraRecording camera(params_);
  EXPECT_EQ(camera.info().sensor, SensorKind::kStereo);
  EXPECT_NEAR(camera.info().camera.baseline_m, 0.12, 1e-9);
  ASSERT_TRUE(camera.info().T_base_camera);
  EXPECT_NEAR(camera.info().T_base_camera->translation().z(), 1.2, 1e-9);
  Frame frame;
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(camera.next(frame));
    EXPECT_EQ(frame.number, static_cast<std::size_t>(i) + 1);
    EXPECT_NEAR(frame.stamp_s, 0.1 * i, 1e-6);
    ASSERT_EQ(frame.image_bgr.size(), cv::Size(64, 48));
    EXPECT_NEAR(cv::mean(frame.image_bgr)[1], 50 + i, 1.5);
    EXPECT_NEAR(cv::mean(frame.right_bgr)[1], 150 + i, 1.5);
  }
  EXPECT_FALSE(camera.next(frame));
  EXPECT_GE(std::chrono::steady_clock::now() - began, std::chrono::milliseconds(300));
}

TEST_F(CameraRecordingTest, NeedsTheCalibrationOfAStereoCamera) {
  params_.calibration.clear();
  EXPECT_THAT([&] { CameraRecording camera(params_); },
              ThrowsMessage<std::runtime_error>(
                  testing::AllOf(HasSubstr("video.avi"), HasSubstr("--calibration"))));
}

TEST_F(CameraRecordingTest, RefusesWhatIsNoCamera) {
  params_.device = folder_ / "none.avi";
  EXPECT_THAT([&] { CameraRecording camera(params_); },
              ThrowsMessage<std::runtime_error>(HasSubstr("no such camera or video")));
  params_.device = folder_ / "stereo.yaml";
  EXPECT_THAT([&] { CameraRecording camera(params_); },
              ThrowsMessage<std::runtime_error>(HasSubstr("no camera or video")));
}

}  // namespace
}  // namespace heel::test
