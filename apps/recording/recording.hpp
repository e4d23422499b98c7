// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Recordings of a robot's camera, read as a stream.
#pragma once

#include <heel/apps/recording/bags/bag_topics.hpp>
#include <heel/apps/recording/frame.hpp>
#include <heel/apps/recording/robot_motion.hpp>
#include <heel/apps/recording/time_span.hpp>
#include <heel/cloud/pinhole_camera.hpp>

#include <Eigen/Geometry>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace heel {

enum class SensorKind { kStereo, kRgbd, kCloud };

/// What holds for the whole of a recording.
struct RecordingInfo {
  std::string name;    ///< The folder's or the file's name.
  std::string layout;  ///< How it is stored, for people to read: "RGB-D folder, TUM layout".
  SensorKind sensor = SensorKind::kRgbd;
  StereoCamera camera;  ///< `left` for RGB-D too (baseline 0); zeros for clouds, unless known.
  std::size_t frame_count = 0;
  double first_s = 0.0;         ///< The first stamp.
  double duration_s = 0.0;      ///< From the first stamp to the last.
  bool nominal_stamps = false;  ///< No times are stored: they are made from the assumed rate.
  /// Where the camera is mounted: maps its optical frame to the base frame. Absent if not known.
  std::optional<Eigen::Isometry3d> T_base_camera;
  std::string base_frame;             ///< What tf calls that base frame; empty: tf does not tell.
  std::vector<std::string> warnings;  ///< What a user should know of how it is read, in sentences.
  std::string lost;  ///< What of a damaged bag can't be read, in a sentence; empty: nothing.
};

/// A frame that could not be read, and why.
struct SkippedFrame {
  std::size_t number = 0;
  std::string reason;  ///< One sentence that names the file.
};

/// How recordings are read; the defaults suit the data sets that we know.
struct RecordingParams {
  double max_stamp_difference_s = 0.02;  ///< Images of one frame are not further apart than this.
  double nominal_rate_hz = 10.0;         ///< Frames per second where the recording stores no times.
  BagTopics topics;                      ///< Topics of bags.
  TimeSpan span;                         ///< The part that is read.
};

/// A recording, read one frame at a time; holds one frame's data at the most, and the list of its
/// files.
class Recording {
 public:
  virtual ~Recording() = default;

  const RecordingInfo& info() const { return info_; }

  /// Reads the next frame into `frame`, whatever it held before.
  /// A frame that can't be read, or whose stamp does not come after the one before it, is left out
  /// and added to `skipped()`.
  /// @return false at the end.
  virtual bool next(Frame& frame) = 0;

  const std::vector<SkippedFrame>& skipped() const { return skipped_; }

  /// Reads how the robot moved, whichever frame is next; absent if the recording does not tell.
  /// @throws std::runtime_error  with one sentence, if what tells it can't be read.
  virtual std::optional<RobotMotion> readMotion() const { return std::nullopt; }

 protected:
  RecordingInfo info_;
  std::vector<SkippedFrame> skipped_;
};

/// Opens whatever recording `path` holds: a folder of stereo images, an RGB-D folder in the TUM
/// layout, a folder of PCD files (or one file), or a bag of ROS 1 or ROS 2 (SQLite or MCAP).
/// @throws std::runtime_error     with one sentence that names the file and the reason.
/// @throws std::invalid_argument  if a parameter is not positive, or the span ends before it
/// begins.
std::unique_ptr<Recording> openRecording(const std::filesystem::path& path,
                                         const RecordingParams& params = {});

/// The sentence for a recording of which no frame could be read: how many there were, and why the
/// first was left out.
std::string nothingReadMessage(const Recording& recording);

/// The same, for frames that were left out by the caller as well.
std::string nothingReadMessage(const Recording& recording,
                               const std::vector<SkippedFrame>& skipped);

/// "44 frames were left out, the first: why", after what comes before that; or nothing at all.
std::string leftOutNote(const std::vector<SkippedFrame>& skipped, const char* before = "; ");

}  // namespace heel
