// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/camera_setup.hpp>
#include <heel/apps/follower/depth_images.hpp>
#include <heel/apps/recording/recording.hpp>
#include <heel/cloud/color_cloud.hpp>

#include <Eigen/Geometry>
#include <pcl/io/pcd_io.h>

#include <cstdio>
#include <filesystem>
#include <string>

/// recording_to_clouds RECORDING FOLDER: a PCD file for each frame, in the camera's frame.
int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const heel::CameraSetup setup = heel::findCameraSetup(*heel::openRecording(argv[1]));
  heel::DepthImages depths(setup.sensor, setup.camera);
  std::filesystem::create_directories(argv[2]);

  const auto recording = heel::openRecording(argv[1]);
  heel::Frame frame;
  heel::ColorCloud cloud;
  while (recording->next(frame)) {
    heel::makeColorCloud(depths.of(frame), frame.image_bgr, setup.camera.left,
                         Eigen::Isometry3d::Identity(), cloud);
    const std::string number = std::to_string(1000000 + frame.number).substr(1);
    const auto file = std::filesystem::path(argv[2]) / (number + ".pcd");
    if (pcl::io::savePCDFileBinaryCompressed(file.string(), cloud) != 0) return 1;
  }
  std::printf("%zu frames, %zu left out\n", recording->info().frame_count,
              recording->skipped().size());
  return 0;
}
