// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The result folder of `heel follow`: report, film, tables and summary.
#pragma once

#include <heel/apps/experiment/closed_loop.hpp>
#include <heel/apps/film/follow_video.hpp>
#include <heel/apps/film/video_writer.hpp>
#include <heel/apps/heel/shared/drawn_perception.hpp>
#include <heel/apps/heel/shared/result_bag.hpp>
#include <heel/apps/pages/pages.hpp>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace heel {

/// What is said when a real robot or a log ends as kNobodyLearned.
inline constexpr const char* kNobodyWasLearned =
    "nobody was learned: that takes about 5 s of the empty room, then one person alone for about "
    "10 s, before a robot that stands; or name by --model whom 'heel learn' has learned";

/// Watches a run, draws it, and writes it down at its end.
class FollowOutput {
 public:
  /// @param film  Also draw the film.
  /// @param bag   Also write this bag; empty: none.
  /// @param inputs  What is read: it is not written over.
  /// @throws std::invalid_argument, OutputError  if the folder or the bag can't be written.
  FollowOutput(const std::filesystem::path& folder, bool film, const std::filesystem::path& bag,
               const std::vector<std::filesystem::path>& inputs);

  /// Also shows the run there, as often as 5 times a second, while somebody looks.
  void showOn(ResultBag& network) { network_ = &network; }

  /// Of the step that is added next.
  void addTime(FollowStage stage, double ms);
  void add(const Readings& readings, const FollowStep& step, const Follower& follower,
           const FollowSample& sample);

  /// Adds the stages' times and the pictures to the log, and writes all files.
  /// @throws std::runtime_error  if one can't be written.
  void commit(FollowLog& log, const FollowSummary& summary);

  const std::filesystem::path& folder() const { return output_.path(); }
  std::string fileNames() const;

 private:
  /// A snapshot that takes little memory.
  struct PackedSnapshot {
    double stamp_s = 0.0;
    std::string caption;
    std::vector<unsigned char> jpeg;
  };

  void keepTimes(bool learns);
  void draw(const Readings& readings, const FollowStep& step, const Follower& follower,
            const FollowSample& sample);
  void addToBag(const Readings& readings, const FollowStep& step, const Follower& follower);
  void keepSnapshot(const FollowSample& sample);
  bool isWorthAPicture(const FollowSample& sample) const;

  Output output_;
  bool film_wanted_;
  std::optional<FollowVideo> video_;
  std::optional<FilmWriter> film_;
  std::vector<double> film_stamps_s_;
  std::optional<ResultBag> bag_;
  ResultBag* network_ = nullptr;
  double shown_s_ = 0.0;  // on the network
  std::optional<DrawnPerception> drawn_;
  FollowVideoFrame frame_;
  cv::Mat picture_;
  std::vector<PackedSnapshot> snapshots_;
  bool has_map_ = false;  // in the bag
  std::string last_state_;
  double last_snapshot_s_ = 0.0;
  std::array<double, kFollowStages> step_ms_{};
  std::array<std::vector<float>, kFollowStages> times_ms_;
  std::vector<float> steps_ms_;
};

}  // namespace heel
