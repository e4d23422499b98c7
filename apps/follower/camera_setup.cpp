// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/camera_setup.hpp>
#include <heel/apps/follower/depth_images.hpp>
#include <heel/cloud/color_cloud.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace heel {
namespace {

/// What is told of the camera's place, before anything is seen.
std::optional<Eigen::Isometry3d> configuredPlace(const Recording& recording,
                                                 const CameraSetupParams& params) {
  const auto& told = recording.info().T_base_camera;
  return told ? told : params.T_base_camera;
}

/// How high base_link is over the floor that is seen, where that and nothing else explains what is
/// seen of it; else 0. The origin of base_link may be anywhere on a robot (REP 105).
double baseHeight(const GroundPlane& floor, const Eigen::Isometry3d& T_base_camera) {
  constexpr double kSameTilt_rad = 0.035;
  const Mounting seen = floor.mounting, told = mountingOf(T_base_camera);
  if (std::abs(seen.pitch_rad - told.pitch_rad) > kSameTilt_rad ||
      std::abs(seen.roll_rad - told.roll_rad) > kSameTilt_rad) {
    return 0.0;
  }
  const double height_m = -(T_base_camera * floor.mean_m).z();
  const Eigen::Isometry3d raised = Eigen::Translation3d(0.0, 0.0, height_m) * T_base_camera;
  return height_m > 0.0 && mountingWarning(floor, raised).empty() ? height_m : 0.0;
}

/// Takes the place of the camera as configured, else from the floor; says if they differ.
void placeCamera(const Recording& recording, const std::optional<Eigen::Isometry3d>& configured,
                 CameraSetup& setup) {
  setup.is_configured = configured.has_value();
  if (!setup.is_configured && !setup.ground) {
    throw std::runtime_error(
        recording.info().name +
        ": the camera's place is not configured (T_ground_camera in camera.yaml, or tf), and no "
        "floor was found in the first seconds");
  }
  setup.T_base_camera = setup.is_configured ? *configured : setup.ground->T_base_camera;
  if (!setup.is_configured || !setup.ground) return;
  const std::string warning = mountingWarning(*setup.ground, *configured);
  if (warning.empty()) return;
  if (recording.info().base_frame == "base_link") {
    setup.base_height_m = baseHeight(*setup.ground, *configured);
  }
  if (setup.base_height_m > 0.0) {
    setup.T_base_camera.pretranslate(Eigen::Vector3d(0.0, 0.0, setup.base_height_m));
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(),
                  "By the floor that is seen base_link is %.2f m over it: heights of camera and "
                  "laser are taken from that floor.",
                  setup.base_height_m);
    setup.warnings.emplace_back(text.data());
  } else {
    setup.warnings.push_back(warning);
  }
}

}  // namespace

CameraSetup findCameraSetup(Recording& recording, const CameraSetupParams& params) {
  CameraSetup setup;
  setup.sensor = recording.info().sensor;
  setup.camera = recording.info().camera;
  SetupCheck check(params.check);
  GroundPlaneEstimator floor(params.ground);
  std::optional<DepthImages> depths;
  const auto identity = Eigen::Isometry3d::Identity();
  Frame frame;
  ColorCloud cloud;
  std::optional<double> first_s;
  while (recording.next(frame)) {
    if (!first_s) {
      first_s = frame.stamp_s;
      if (frame.cloud != nullptr && setup.camera.left.fx == 0.0) {
        setup.camera.left = fitPinhole(*frame.cloud).value_or(PinholeCamera());
      }
      depths.emplace(setup.sensor, setup.camera, params.stereo);
      if (setup.sensor == SensorKind::kStereo) {
        StereoMatcher matcher(params.stereo);
        check.addPair(frame.image_bgr, frame.right_bgr, matcher);
      }
    }
    if (frame.stamp_s > *first_s + params.look_at_s) break;
    if (frame.cloud != nullptr) {
      floor.add(*frame.cloud);
      if (!frame.image_bgr.empty()) check.add(frame.stamp_s, frame.image_bgr, depths->of(frame));
    } else {
      const cv::Mat& depth_m = depths->of(frame);
      check.add(frame.stamp_s, frame.image_bgr, depth_m);
      if (!floor.isFull()) {
        makeColorCloud(depth_m, frame.image_bgr, setup.camera.left, identity, cloud);
        floor.add(cloud);
      }
    }
  }
  if (!first_s) throw std::runtime_error(nothingReadMessage(recording));
  setup.report = check.report();
  setup.warnings = setup.report.warnings;
  const std::vector<std::string>& read = recording.info().warnings;
  setup.warnings.insert(setup.warnings.end(), read.begin(), read.end());
  if (!recording.info().lost.empty()) setup.warnings.push_back(recording.info().lost);
  if (setup.report.swapped) {
    throw std::runtime_error(recording.info().name +
                             ": left and right images are swapped: all disparities are negative");
  }
  const auto configured = configuredPlace(recording, params);
  std::optional<Eigen::Vector4d> expected;
  if (configured) expected = configured->matrix().row(2);
  setup.ground = floor.estimate(expected);
  placeCamera(recording, configured, setup);
  return setup;
}

}  // namespace heel
