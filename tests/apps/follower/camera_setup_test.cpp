// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/camera_setup.hpp>

#include <gmock/gmock.h>
#include <opencv2/core.hpp>

namespace heel {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

constexpr double kHeight_m = 1.15, kPitch_rad = 0.2;

/// Ten pictures by a depth camera over a plain floor.
class OverAFloor final : public Recording {
 public:
  OverAFloor() {
    info_.name = "a recording";
    info_.sensor = SensorKind::kRgbd;
    info_.camera.left = {160, 120, 130.0, 130.0, 79.5, 59.5};
    const Eigen::Isometry3d T = baseFromCamera({kHeight_m, kPitch_rad, 0.0});
    depth_m_.create(120, 160, CV_32FC1);
    for (int v = 0; v < depth_m_.rows; ++v) {
      for (int u = 0; u < depth_m_.cols; ++u) {
        const double down = -(T.linear() * rayOf(info_.camera.left, u, v)).z();
        depth_m_.at<float>(v, u) = down > 0.0 ? static_cast<float>(kHeight_m / down) : 0.0F;
      }
    }
  }

  /// As tf tells it.
  OverAFloor& at(const Mounting& mounting, const std::string& base) {
    info_.T_base_camera = baseFromCamera(mounting);
    info_.base_frame = base;
    return *this;
  }

  bool next(Frame& frame) override {
    if (count_ == 10) return false;
    frame = {};
    frame.number = static_cast<std::size_t>(count_);
    frame.stamp_s = 0.1 * count_++;
    frame.image_bgr = cv::Mat(depth_m_.size(), CV_8UC3, cv::Scalar::all(128));
    frame.depth_m = depth_m_.clone();
    return true;
  }

 private:
  cv::Mat depth_m_;
  int count_ = 0;
};

TEST(CameraSetup, ABaseLinkAboveTheFloorIsTakenAsHighAsTheFloorThatIsSeenTells) {
  OverAFloor recording;
  recording.at({kHeight_m - 0.13, kPitch_rad, 0.0}, "base_link");
  const CameraSetup setup = findCameraSetup(recording);
  EXPECT_TRUE(setup.is_configured);
  EXPECT_NEAR(setup.base_height_m, 0.13, 1e-3);
  EXPECT_NEAR(setup.T_base_camera.translation().z(), kHeight_m, 1e-3);
  EXPECT_THAT(setup.warnings, Contains(HasSubstr("base_link is 0.13 m over it")));
  EXPECT_THAT(setup.warnings, Not(Contains(HasSubstr("correct the mounting"))));
}

TEST(CameraSetup, AFootprintIsOnTheFloorWhateverIsSeen) {
  OverAFloor recording;
  recording.at({kHeight_m - 0.13, kPitch_rad, 0.0}, "base_footprint");
  const CameraSetup setup = findCameraSetup(recording);
  EXPECT_EQ(setup.base_height_m, 0.0);
  EXPECT_NEAR(setup.T_base_camera.translation().z(), kHeight_m - 0.13, 1e-9);
  EXPECT_THAT(setup.warnings, Contains(HasSubstr("correct the mounting")));
}

TEST(CameraSetup, ACameraThatTfTiltsOtherwiseIsNotMendedByItsHeight) {
  for (const Mounting& told :
       {Mounting{kHeight_m - 0.13, kPitch_rad + 0.1, 0.0},
        Mounting{kHeight_m - 0.13, kPitch_rad, 0.1}, Mounting{kHeight_m + 0.13, kPitch_rad, 0.0}}) {
    OverAFloor recording;
    recording.at(told, "base_link");
    const CameraSetup setup = findCameraSetup(recording);
    EXPECT_EQ(setup.base_height_m, 0.0);
    EXPECT_THAT(setup.warnings, Contains(HasSubstr("correct the mounting")));
  }
}

TEST(CameraSetup, TheParametersTellThePlaceWhereTheRecordingDoesNot) {
  CameraSetupParams params;
  params.T_base_camera =
      Eigen::Translation3d(0.3, 0.1, 0.0) * baseFromCamera({kHeight_m, kPitch_rad, 0.0});
  OverAFloor untold;
  const CameraSetup setup = findCameraSetup(untold, params);
  EXPECT_TRUE(setup.is_configured);
  EXPECT_TRUE(setup.T_base_camera.isApprox(*params.T_base_camera));
  OverAFloor told;
  told.at({kHeight_m, kPitch_rad, 0.0}, "base_link");
  EXPECT_TRUE(findCameraSetup(told, params)
                  .T_base_camera.isApprox(baseFromCamera({kHeight_m, kPitch_rad, 0.0})));
}

}  // namespace
}  // namespace heel
