// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The result files of a run, and the truth that they are compared with.
#pragma once

#include <heel/apps/output/csv_file.hpp>
#include <heel/mapping/floor_pose.hpp>

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace heel {

/// One track at one moment: a row of tracks.csv.
struct TrackRow {
  double stamp_s = 0.0;
  int track_id = 0;
  bool is_target = false;
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();  ///< On the floor.
  Eigen::Vector2d velocity_mps = Eigen::Vector2d::Zero();
  double score = 0.0;
  std::string status;               ///< For instance "confirmed" or "coasting".
  double person_probability = 1.0;  ///< That it is a person, not a thing.
};

/// What every stage left of one frame: a row of frames.csv.
struct FrameRow {
  std::size_t frame = 0;  ///< Counts from 1.
  double stamp_s = 0.0;
  int color_pixels = 0;     ///< Pixels that passed the colour filter.
  int color_points = 0;     ///< Of those, points with a place.
  int standing_points = 0;  ///< Of those, points within the height crop.
  int blobs = 0;            ///< World blobs of them.
  int observations = 0;     ///< Blobs that passed the geometric gate.
  int tracks = 0;           ///< Tracks alive after the frame.
  int target_id = 0;        ///< The target's track; 0 if there is none.
  double confidence = 0.0;  ///< Of the target, in [0, 1].
  std::string state;        ///< For instance "following", "ambiguous", "lost", "skipped".
  std::string reason;       ///< Why there is no target; empty if there is one.
  FloorPose robot = {};     ///< The base frame in the frame of the results.
};

/// Where one person was at one moment: a row of truth.csv.
struct TruthRow {
  double stamp_s = 0.0;
  std::size_t frame = 0;
  std::string person;
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  bool exact = true;  ///< False where less than a quarter of them is seen.
};

/// tracks.csv, frames.csv and timing.csv of a run, written as it goes on.
class ResultFiles {
 public:
  /// @param stages  Names of the stages that are timed; columns of timing.csv are "STAGE_ms". None:
  ///                there is no such file.
  /// @throws OutputError  if a file can't be written; so do the others.
  explicit ResultFiles(const Output& output, const std::vector<std::string>& stages = {});

  void add(const TrackRow& row);
  void add(const FrameRow& row);

  /// @param stages_ms  Milliseconds of each of the stages, in the constructor's order.
  void addTiming(std::size_t frame, const std::vector<double>& stages_ms);

  /// Ends the writing.
  void close();

 private:
  CsvWriter tracks_;
  CsvWriter frames_;
  std::optional<CsvWriter> timing_;
};

/// Writes summary.json and the like: indented, keys in the order in which they were added. Bytes
/// that are not UTF-8, as names of files may have, become U+FFFD.
/// @throws OutputError  as OutputFile.
void writeJson(const OutputPath& file, const nlohmann::ordered_json& value);

/// Reads tracks.csv.
/// @throws std::runtime_error  with one sentence that names the file and the line.
std::vector<TrackRow> readTracks(const std::filesystem::path& file);

/// Reads frames.csv.
/// @throws std::runtime_error  with one sentence that names the file and the line.
std::vector<FrameRow> readFrames(const std::filesystem::path& file);

/// Reads truth.csv: `stamp_s,frame,person,x_m,y_m,exact`.
/// @throws std::runtime_error  with one sentence that names the file and the line.
std::vector<TruthRow> readTruth(const std::filesystem::path& file);

}  // namespace heel
