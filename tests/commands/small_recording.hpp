// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A small RGB-D recording: a room with a wall and a floor, which somebody in a red jumper enters.
#pragma once

#include <opencv2/core.hpp>

#include <filesystem>
#include <string>

namespace heel::test {

/// How long it is. The camera is 1 m over the floor and looks ahead; five frames a second.
struct SmallRecording {
  static inline const cv::Vec3b kJumper = {45, 40, 190};  // BGR, as the others
  static inline const cv::Vec3b kWall = {150, 160, 155};
  static inline const cv::Vec3b kFloor = {90, 115, 125};

  int empty_frames = 26;
  int person_frames = 40;
  bool has_mounting = true;  ///< Whether camera.yaml tells where the camera is.

  int frames() const { return empty_frames + person_frames; }

  /// Writes it in the TUM layout, with camera.yaml and truth.csv, to a new folder.
  void write(const std::filesystem::path& folder) const;
};

/// The images of frame `number` (from 1) of a small recording.
std::filesystem::path colorImage(const std::filesystem::path& folder, int number);
std::filesystem::path depthImage(const std::filesystem::path& folder, int number);

}  // namespace heel::test
