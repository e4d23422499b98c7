// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The files of a recording, as `simulate` describes them.
#pragma once

#include "apps/simulation/simulator.hpp"

#include <tbb/task_group.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>

namespace heel {

/// Writes readings to a folder; pictures are encoded beside whatever the caller does next.
class RecordingWriter {
 public:
  /// @throws std::runtime_error  if the folder holds something or can't be made.
  RecordingWriter(const std::filesystem::path& folder, const Simulator& simulator,
                  bool pixel_truth);
  ~RecordingWriter();
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;

  void add(const Readings& readings);

  /// Completes the files and gives the folder its name.
  void finish();

  std::size_t frames() const { return frames_; }

 private:
  void writeCameraFiles(const Simulator& simulator);
  void addFrame(const Readings& readings);
  void addTruth(const Readings& readings);
  std::ofstream& table(const std::string& name, const std::string& header);
  void writeLine(const std::string& name, const std::string& header, const std::string& line);
  void writeImage(const std::string& folder, const cv::Mat& image);

  std::filesystem::path folder_;
  std::filesystem::path partial_;  // Where the files are until all are there.
  bool pixel_truth_;
  bool finished_ = false;
  StereoCamera camera_;
  Eigen::Isometry3d T_base_camera_;
  Eigen::Isometry3d T_ground_world_ = Eigen::Isometry3d::Identity();
  std::size_t frames_ = 0;
  std::map<std::string, std::ofstream> tables_;
  tbb::task_group encoding_;
};

}  // namespace heel
