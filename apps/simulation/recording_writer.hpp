// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The files of a recording, as `simulate` describes them.
#pragma once

#include <heel/apps/output/output.hpp>
#include <heel/apps/simulation/simulator.hpp>

#include <tbb/task_group.h>

#include <filesystem>
#include <map>
#include <string>

namespace heel {

/// Writes readings to a folder; pictures are encoded beside whatever the caller does next.
class RecordingWriter {
 public:
  /// @throws std::invalid_argument  if the folder holds something.
  /// @throws OutputError  if nothing can be written there; so do the others.
  RecordingWriter(const std::filesystem::path& folder, const Simulator& simulator);
  ~RecordingWriter();
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;

  void add(const Readings& readings);

  /// Completes the files and gives the folder its place.
  /// @param complete  False if the simulation was stopped: summary.json says so.
  void finish(bool complete);

  std::size_t frames() const { return frames_; }

 private:
  void writeCameraFiles(const Simulator& simulator);
  void addFrame(const Readings& readings);
  void addTruth(const Readings& readings);
  OutputFile& table(const std::string& name, const std::string& header);
  void writeLine(const std::string& name, const std::string& header, const std::string& line);
  void writeImage(const std::string& folder, const cv::Mat& image);

  Output output_;
  StereoCamera camera_;
  Eigen::Isometry3d T_base_camera_;
  Eigen::Isometry3d T_ground_world_ = Eigen::Isometry3d::Identity();
  std::size_t frames_ = 0;
  double stamp_s_ = 0.0;
  std::map<std::string, OutputFile> tables_;
  tbb::task_group encoding_;
};

}  // namespace heel
