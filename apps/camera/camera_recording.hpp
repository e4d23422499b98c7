// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A camera that is on, read as recordings are.
#pragma once

#include <heel/apps/camera/pair_camera.hpp>

#include <chrono>
#include <memory>
#include <optional>

namespace heel {

/// Pairs of a camera as rectified frames, as they come. A video comes in real time, or slower.
class CameraRecording final : public Recording {
 public:
  /// Waits for the first pair.
  /// @throws std::runtime_error  if none comes, or the camera is not calibrated.
  explicit CameraRecording(const PairCameraParams& params);

  /// @throws std::runtime_error  if the camera fails.
  bool next(Frame& frame) override;

 private:
  bool awaitPair();

  std::unique_ptr<PairCamera> camera_;
  std::optional<StereoRig> rig_;  // absent: RGB-D
  double depth_scale_ = 0.0;
  bool has_first_ = false;  // It is read, and not yet handed on.
  std::size_t count_ = 0;
  std::optional<std::chrono::steady_clock::time_point> zero_;  // of a video's stamps
};

}  // namespace heel
