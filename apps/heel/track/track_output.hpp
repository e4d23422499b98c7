// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The result folder of `heel track`: report, tables, film, stills and summary.
#pragma once

#include <heel/apps/film/video_writer.hpp>
#include <heel/apps/follower/perception.hpp>
#include <heel/apps/heel/shared/drawn_perception.hpp>
#include <heel/apps/heel/shared/result_bag.hpp>
#include <heel/apps/results/result_files.hpp>
#include <heel/apps/results/track_log.hpp>
#include <heel/segmentation/appearance_model.hpp>

#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace heel {

/// Whom a model knows, for people to see.
struct PicturedPerson {
  std::string name;
  cv::Mat colors_bgr;   ///< drawAppearance() of the model.
  cv::Mat learned_bgr;  ///< The picture that `heel learn` wrote beside the model; empty: none.
};

/// @param file  Of the model.
PicturedPerson picturedPerson(const std::filesystem::path& file, const AppearanceModel& model);

struct TrackOutputParams {
  bool film = true;                             ///< Also draw the film and the stills.
  std::filesystem::path bag;                    ///< Also write this bag; empty: none.
  std::vector<std::filesystem::path> inputs;    ///< What is read: it is not written over.
  std::size_t stills = 6;                       ///< Spread over the frames that have a target.
  std::optional<Eigen::AlignedBox2d> bounds_m;  ///< To draw.
  PicturedPerson person;                        ///< For the report.
  std::string frame;  ///< Of all places: the map, or the odometry; empty: the base frame.
};

/// Milliseconds that each stage of a frame took.
using StageTimes = std::array<double, kStages>;

/// What became of a run.
struct TrackEnd {
  bool complete = true;  ///< False if it was stopped.
  std::vector<SkippedFrame> skipped;
  std::vector<std::string> warnings;
};

/// Writes a run as it goes on; it gets its place at commit().
class TrackOutput {
 public:
  /// @throws std::invalid_argument  if it may not be written there, see Output.
  /// @throws OutputError  if it can't be; so do the others.
  TrackOutput(const std::filesystem::path& folder, const RecordingInfo& info,
              const CameraSetup& setup, const TrackOutputParams& params);

  /// @param robot  Where it was, as it was given to the perception.
  void add(const Frame& frame, const FloorPose& robot, const Perception& perception,
           const PerceptionStep& step, const StageTimes& times_ms);

  /// Writes the summary and the stills, and gives all files their place.
  void commit(const TrackEnd& end);

  /// Where commit() wrote, and what, for people to read.
  const std::filesystem::path& folder() const { return output_.path(); }
  std::string fileNames() const;

  std::size_t frames() const { return frames_; }
  std::size_t framesWithTarget() const { return frames_with_target_; }
  const std::map<std::string, std::size_t>& framesByState() const { return states_; }
  /// Why there was no target in most of the frames without one; empty if none was without.
  std::string commonestReason() const;

 private:
  bool moves() const { return !params_.frame.empty(); }
  void addRows(const Frame& frame, const FloorPose& robot, const Perception& perception,
               const PerceptionStep& step);
  void keepStill();

  Output output_;
  RecordingInfo info_;
  CameraSetup setup_;
  TrackOutputParams params_;
  ResultFiles files_;
  std::optional<FilmWriter> film_;
  std::vector<double> film_stamps_s_;
  TrackLog log_;
  std::optional<ResultBag> bag_;
  cv::Mat picture_;
  DrawnPerception drawn_;
  struct Still {
    std::size_t frame;
    double stamp_s;
    cv::Mat picture;
  };
  std::vector<Still> stills_;
  std::size_t still_step_ = 1;  // every so many frames with a target
  std::size_t frames_ = 0;
  std::size_t frames_with_target_ = 0;
  std::map<std::string, std::size_t> states_;
  std::map<std::string, std::size_t> reasons_;
};

}  // namespace heel
