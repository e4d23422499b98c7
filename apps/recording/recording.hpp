// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Recordings of a robot's camera, read as a stream.
#pragma once

#include "apps/recording/frame.hpp"
#include "cloud/pinhole_camera.hpp"

#include <Eigen/Geometry>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace heel {

enum class SensorKind { kStereo, kRgbd, kCloud };

/// What holds for the whole of a recording.
struct RecordingInfo {
  std::string name;
  SensorKind sensor = SensorKind::kRgbd;
  StereoCamera camera;  ///< `left` for RGB-D too (baseline 0); zeros for clouds.
  std::size_t frame_count = 0;
  double duration_s = 0.0;
  /// Where the camera is mounted: maps its optical frame to the base frame. Absent if not known.
  std::optional<Eigen::Isometry3d> T_base_camera;
};

/// A frame that could not be read, and why.
struct SkippedFrame {
  std::size_t number = 0;
  std::string reason;  ///< One sentence that names the file.
};

/// A recording, read one frame at a time; holds one frame's data at the most.
class Recording {
 public:
  virtual ~Recording() = default;

  const RecordingInfo& info() const { return info_; }

  /// Reads the next frame into `frame`, reusing its memory.
  /// A frame that can't be read is left out and added to `skipped()`.
  /// @return false at the end.
  virtual bool next(Frame& frame) = 0;

  const std::vector<SkippedFrame>& skipped() const { return skipped_; }

 protected:
  RecordingInfo info_;
  std::vector<SkippedFrame> skipped_;
};

/// Opens whatever recording `path` holds: a folder of stereo images, an RGB-D folder in the TUM
/// layout, or a folder of PCD files (or one file).
/// @throws std::runtime_error  with one sentence that names the file and the reason.
std::unique_ptr<Recording> openRecording(const std::filesystem::path& path);

}  // namespace heel
