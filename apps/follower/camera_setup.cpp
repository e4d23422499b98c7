// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/camera_setup.hpp>
#include <heel/apps/follower/depth_images.hpp>
#include <heel/cloud/color_cloud.hpp>

#include <stdexcept>

namespace heel {
namespace {

/// Takes the place of the camera from the recording, else from the floor; says if they differ.
void placeCamera(const Recording& recording, CameraSetup& setup) {
  const auto& configured = recording.info().T_base_camera;
  setup.is_configured = configured.has_value();
  if (!setup.is_configured && !setup.ground) {
    throw std::runtime_error(
        recording.info().name +
        ": the camera's place is not configured (T_ground_camera in camera.yaml, or tf), and no "
        "floor was found in the first seconds");
  }
  setup.T_base_camera = setup.is_configured ? *configured : setup.ground->T_base_camera;
  if (setup.is_configured && setup.ground) {
    const std::string warning = mountingWarning(*setup.ground, *configured);
    if (!warning.empty()) setup.warnings.push_back(warning);
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
  std::optional<Eigen::Vector4d> configured;
  if (recording.info().T_base_camera) configured = recording.info().T_base_camera->matrix().row(2);
  setup.ground = floor.estimate(configured);
  placeCamera(recording, setup);
  return setup;
}

}  // namespace heel
