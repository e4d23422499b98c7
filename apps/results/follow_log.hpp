// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// All that a run of following leaves to be told: one sample a control step, with the truth; and
/// what is counted over it.
#pragma once

#include <heel/apps/output/output.hpp>
#include <heel/mapping/floor_pose.hpp>
#include <heel/mapping/occupancy_grid.hpp>
#include <heel/planning/trajectory.hpp>

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <opencv2/core/mat.hpp>

#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace heel {

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

/// One control step. Places are in the map's frame; NaN stands for what is not known.
struct FollowSample {
  double stamp_s = 0.0;
  FloorPose robot_true;
  FloorPose robot_estimated;
  double position_sigma_m = kNotKnown;  ///< Standard deviation that the localization states.
  bool is_localized = false;            ///< The localization does not say that it is lost.
  VelocityCommand command;
  VelocityCommand speed_true;
  std::string state;  ///< The plan's active action: "learn", "follow", "face", "seek", ...
  std::string reason;
  std::string target_status;                       ///< For instance "followed", "lost".
  double confidence = kNotKnown;                   ///< TargetEstimate::confidence.
  std::optional<Eigen::Vector2d> person_true;      ///< Absent while they are not in the scene.
  std::optional<Eigen::Vector2d> target_estimate;  ///< Absent while the target is lost.
  std::vector<Eigen::Vector2d> others_true;
  double person_distance_m = kNotKnown;  ///< True distance of the person from the robot's middle.
  double clearance_m = kNotKnown;        ///< True gap between the robot and the nearest thing.
  double candidate_share = kNotKnown;    ///< Of the picture's pixels: with the target's colours.
  bool contact = false;
  bool contact_by_robot = false;  ///< The robot moved towards what it touched.
  bool wrong_person = false;      ///< See isWrongPerson().
};

/// Whether the estimate is somebody else's place: further than 0.5 m from the person (or the
/// person is not there), and nearer to one of the others.
bool isWrongPerson(const Eigen::Vector2d& estimate, const std::optional<Eigen::Vector2d>& person,
                   const std::vector<Eigen::Vector2d>& others);

/// A picture taken on the way.
struct FollowSnapshot {
  double stamp_s = 0.0;
  std::string caption;
  cv::Mat picture_bgr;
};

/// Milliseconds of one stage of a step.
struct StageTime {
  std::string name;
  double mean_ms = 0.0;
  double median_ms = 0.0;
  double p95_ms = 0.0;
};

/// The outcome of a run that a signal ended.
inline constexpr const char* kStoppedRun = "stopped";
/// The outcome of a run in which phase 1 found nobody, or several people.
inline constexpr const char* kNobodyLearned = "nobody learned";

/// A whole run.
struct FollowLog {
  std::string scene;
  unsigned long seed = 0;
  std::string plan;  ///< Name of the Petri net plan.
  /// The follower ran on a log: its commands moved nothing, and `speed_true` is what the robot did.
  bool is_shadow = false;
  bool is_live = false;  ///< A robot was driven, and nobody knows the truth.
  /// Whether contacts, clearance, people and the robot's place are known, as in simulation.
  bool hasTruth() const { return !is_shadow && !is_live; }
  std::string command;  ///< The command line that repeats the run; may be empty.
  std::string outcome;  ///< The follower's own word: "reached", "failed", "done", "timeout", ...
  std::string person;   ///< Whom to follow.
  OccupancyGrid map;
  DriveLimits drive;
  std::vector<FollowSample> samples;  ///< In order of time.
  std::vector<FollowSnapshot> snapshots;
  std::vector<StageTime> stages;
  StageTime step;                   ///< All stages of a step together, once the person is learned.
  std::vector<double> latencies_s;  ///< Of a live run: from each picture to its velocity.
  double camera_rate_hz = 0.0;      ///< What the stages must keep up with; 0 = not told.
};

/// The moment when the target was lost, or found again.
struct TargetEvent {
  double stamp_s = 0.0;
  bool is_found = false;
  Eigen::Vector2d place_m = Eigen::Vector2d::Zero();  ///< Where the target was taken to be.
};

/// Losses of the target and its recoveries, in order. A gap of up to `tolerance_s` is no loss. The
/// first time that there is a target is no event.
std::vector<TargetEvent> targetEvents(const std::vector<FollowSample>& samples,
                                      double tolerance_s = 0.5);

/// A stretch of time in one state.
struct StateSpan {
  std::string state;
  double from_s = 0.0;
  double to_s = 0.0;
};

/// The states, or another text of the samples, in order; one lasts until the first sample of the
/// next.
/// @tparam Sample  Has a `stamp_s`.
template <typename Sample>
std::vector<StateSpan> stateSpans(const std::vector<Sample>& samples,
                                  std::string Sample::*text = &Sample::state) {
  std::vector<StateSpan> spans;
  for (const Sample& sample : samples) {
    if (!spans.empty()) spans.back().to_s = sample.stamp_s;
    if (spans.empty() || spans.back().state != sample.*text) {
      spans.push_back({sample.*text, sample.stamp_s, sample.stamp_s});
    }
  }
  return spans;
}

/// The figures of a run. Learning (states "learn") is left out of all of them but `learn_s`.
///
/// A sample stands for the time until the next one; the last one for none. What can't be told is
/// NaN. The paper's columns are `distance_m`, `elapsed_s`, `seek_s` and `moving_speed_mps`.
struct FollowSummary {
  std::string outcome;
  double learn_s = 0.0;
  double elapsed_s = 0.0;
  double seek_s = 0.0;                   ///< In states that look for the person: see isSeeking().
  double distance_m = 0.0;               ///< Length of the robot's true path.
  double moving_speed_mps = kNotKnown;   ///< distance_m / (elapsed_s - seek_s), as in Table 1.
  double driving_speed_mps = kNotKnown;  ///< Over the time in which the wheels really drive.
  double best_distance_m = kNotKnown;    ///< Least distance to the person.
  double last_distance_m = kNotKnown;    ///< Distance to the person at the end.
  double with_target_s = 0.0;            ///< With an estimate of the target's place.
  double wrong_person_s = 0.0;
  double near_others_s = 0.0;  ///< In the personal zone, 1.2 m, of somebody else than the person.
  int losses = 0;              ///< Of the target; see targetEvents().
  int contacts = 0;            ///< Separate ones: from a touch until it ends.
  int contacts_by_robot = 0;   ///< In which the robot moved towards what it touched.
  double min_clearance_m = kNotKnown;  ///< 0 in contact.
  double localized_s = 0.0;            ///< The next two are over this time.
  double position_rms_m = kNotKnown;   ///< Of the estimated against the true pose.
  double yaw_rms_rad = kNotKnown;
  double person_error_rms_m = kNotKnown;  ///< Of the target's estimate, while it is the person's.
  /// Of a shadow: root mean squares of what it would have driven against what the robot did.
  double command_off_mps = kNotKnown;
  double command_off_radps = kNotKnown;
  double candidate_share = kNotKnown;   ///< Mean over the pictures: pixels of the target's colours.
  double latency_median_s = kNotKnown;  ///< Of a live run: from a picture to its velocity,
  double latency_p95_s = kNotKnown;     ///< and in 95 of 100.

  double seekShare() const { return elapsed_s > 0.0 ? seek_s / elapsed_s : 0.0; }
  int contactsByPeople() const { return contacts - contacts_by_robot; }
  double wrongShare() const { return elapsed_s > 0.0 ? wrong_person_s / elapsed_s : 0.0; }
};

/// Whether the state is one of those that look for a lost person: "seek" (turning, the paper's
/// seek time) and "search" (driving to where they can have gone). Driving to where they were last
/// seen is on the way, and does not count, as in the paper.
bool isSeeking(const std::string& state);

FollowSummary summarize(const FollowLog& log);

/// The value that this share of them does not exceed; NaN if there are none.
double shareOf(std::vector<double> values, double share);

/// A row of the paper's Table 1.
struct PaperRow {
  const char* name;
  double distance_m, elapsed_s, seek_s, moving_speed_mps;
};

/// A run's figures as such a row.
PaperRow paperRow(const FollowSummary& summary, const char* name = "");

extern const std::array<PaperRow, 3> kPaperTable1;

/// The summary as it stands in summary.json; what is not finite is null. A run that was stopped is
/// not "complete".
nlohmann::ordered_json followJson(const FollowLog& log, const FollowSummary& summary);

/// Writes summary.json, follow.csv and timing.csv of a run. The same run gives the same bytes; only
/// timing.csv depends on the machine.
/// @throws OutputError  as OutputFile.
void writeFollowFiles(const Output& output, const FollowLog& log, const FollowSummary& summary);

}  // namespace heel
