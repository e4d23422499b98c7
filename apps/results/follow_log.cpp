// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/output/csv_file.hpp>
#include <heel/apps/results/follow_log.hpp>
#include <heel/apps/results/result_files.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace heel {

bool isWrongPerson(const Eigen::Vector2d& estimate, const std::optional<Eigen::Vector2d>& person,
                   const std::vector<Eigen::Vector2d>& others) {
  constexpr double kApart_m = 0.5;
  const double to_person =
      person ? (estimate - *person).norm() : std::numeric_limits<double>::infinity();
  return to_person > kApart_m && std::any_of(others.begin(), others.end(), [&](const auto& other) {
           return (estimate - other).norm() < to_person;
         });
}

std::vector<TargetEvent> targetEvents(const std::vector<FollowSample>& samples,
                                      double tolerance_s) {
  std::vector<TargetEvent> events;
  const FollowSample* last_seen = nullptr;
  bool is_lost = false;
  for (const FollowSample& sample : samples) {
    if (last_seen != nullptr && !is_lost && sample.stamp_s - last_seen->stamp_s > tolerance_s) {
      is_lost = true;
      events.push_back({last_seen->stamp_s, false, *last_seen->target_estimate});
    }
    if (!sample.target_estimate) continue;
    if (is_lost) events.push_back({sample.stamp_s, true, *sample.target_estimate});
    is_lost = false;
    last_seen = &sample;
  }
  return events;
}

namespace {

constexpr double kDrives_mps = 0.01;
constexpr double kPersonalZone_m = 1.2;  // Hall, The Hidden Dimension, 1966.
constexpr const char* kLearning = "learn";

/// A root mean square, weighted with time.
struct MeanSquare {
  double sum = 0.0, duration_s = 0.0;
  void add(double error, double dt_s) {
    if (!std::isfinite(error)) return;
    sum += error * error * dt_s;
    duration_s += dt_s;
  }
  double root() const { return duration_s > 0.0 ? std::sqrt(sum / duration_s) : kNotKnown; }
};

/// The lesser of both that is a number.
double least(double a, double b) { return std::fmin(a, b); }

nlohmann::ordered_json numberOrNull(double value, int decimals) {
  if (!std::isfinite(value)) return nullptr;
  const double unit = std::pow(10.0, decimals);
  return std::round(value * unit) / unit;
}

CsvWriter followCsv(const OutputPath& file) {
  return {file,
          {"stamp_s",
           "state",
           "reason",
           "target_status",
           "confidence",
           "x_m",
           "y_m",
           "yaw_rad",
           "estimated_x_m",
           "estimated_y_m",
           "estimated_yaw_rad",
           "position_sigma_m",
           "localized",
           "command_mps",
           "command_radps",
           "speed_mps",
           "turn_radps",
           "person_x_m",
           "person_y_m",
           "target_x_m",
           "target_y_m",
           "distance_m",
           "clearance_m",
           "contact",
           "contact_by_robot",
           "wrong_person"}};
}

void addPlace(CsvWriter& csv, const std::optional<Eigen::Vector2d>& place) {
  const Eigen::Vector2d at = place.value_or(Eigen::Vector2d(kNotKnown, kNotKnown));
  csv.number(at.x(), 3).number(at.y(), 3);
}

void addPose(CsvWriter& csv, const FloorPose& pose) {
  csv.number(pose.position.x(), 4).number(pose.position.y(), 4).number(pose.yaw_rad, 5);
}

void addRows(CsvWriter& csv, const FollowLog& log) {
  for (const FollowSample& s : log.samples) {
    csv.number(s.stamp_s, 3).text(s.state).text(s.reason).text(s.target_status);
    csv.number(s.confidence, 3);
    addPose(csv, s.robot_true);
    addPose(csv, s.robot_estimated);
    csv.number(s.position_sigma_m, 4).flag(s.is_localized);
    csv.number(s.command.forward_mps, 4).number(s.command.turn_radps, 4);
    csv.number(s.speed_true.forward_mps, 4).number(s.speed_true.turn_radps, 4);
    addPlace(csv, s.person_true);
    addPlace(csv, s.target_estimate);
    csv.number(s.person_distance_m, 3).number(s.clearance_m, 3);
    csv.flag(s.contact).flag(s.contact_by_robot).flag(s.wrong_person);
    csv.endRow();
  }
}

}  // namespace

const std::array<PaperRow, 3> kPaperTable1 = {{{"Experiment 1", 24.38, 290.41, 165.35, 0.19},
                                               {"Experiment 2", 18.17, 212.98, 131.21, 0.22},
                                               {"Experiment 3", 20.02, 206.20, 122.81, 0.24}}};

PaperRow paperRow(const FollowSummary& summary, const char* name) {
  return {name, summary.distance_m, summary.elapsed_s, summary.seek_s, summary.moving_speed_mps};
}

bool isSeeking(const std::string& state) { return state == "seek" || state == "search"; }

FollowSummary summarize(const FollowLog& log) {
  FollowSummary sum;
  sum.outcome = log.outcome;
  for (const TargetEvent& event : targetEvents(log.samples)) sum.losses += event.is_found ? 0 : 1;
  MeanSquare position, yaw, person, forward, turn;
  double driven_m = 0.0, driven_s = 0.0;
  double candidates = 0.0;
  int pictures = 0;
  bool was_contact = false, was_by_robot = false;
  for (std::size_t i = 0; i < log.samples.size(); ++i) {
    const FollowSample& s = log.samples[i];
    const FollowSample& next = log.samples[std::min(i + 1, log.samples.size() - 1)];
    const double dt_s = std::max(0.0, next.stamp_s - s.stamp_s);
    if (s.state == kLearning) {
      sum.learn_s += dt_s;
      continue;
    }
    const double step_m = (next.robot_true.position - s.robot_true.position).norm();
    if (std::isfinite(step_m)) sum.distance_m += step_m;
    sum.elapsed_s += dt_s;
    if (isSeeking(s.state)) sum.seek_s += dt_s;
    if (step_m > kDrives_mps * dt_s) {
      driven_m += step_m;
      driven_s += dt_s;
    }
    if (s.target_estimate) sum.with_target_s += dt_s;
    if (s.wrong_person) sum.wrong_person_s += dt_s;
    const auto isNear = [&s](const Eigen::Vector2d& other) {
      return (other - s.robot_true.position).norm() < kPersonalZone_m;
    };
    if (std::any_of(s.others_true.begin(), s.others_true.end(), isNear)) sum.near_others_s += dt_s;
    if (log.is_shadow) {
      forward.add(s.command.forward_mps - s.speed_true.forward_mps, dt_s);
      turn.add(s.command.turn_radps - s.speed_true.turn_radps, dt_s);
    }
    if (s.contact && !was_contact) ++sum.contacts;
    if (!s.contact) was_by_robot = false;
    if (s.contact_by_robot && !was_by_robot) ++sum.contacts_by_robot;
    was_by_robot = was_by_robot || s.contact_by_robot;
    was_contact = s.contact;
    sum.min_clearance_m = least(sum.min_clearance_m, s.contact ? 0.0 : s.clearance_m);
    sum.best_distance_m = least(sum.best_distance_m, s.person_distance_m);
    if (std::isfinite(s.person_distance_m)) sum.last_distance_m = s.person_distance_m;
    if (std::isfinite(s.candidate_share)) {
      candidates += s.candidate_share;
      ++pictures;
    }
    if (s.is_localized) {
      sum.localized_s += dt_s;
      position.add((s.robot_estimated.position - s.robot_true.position).norm(), dt_s);
      yaw.add(wrapped(s.robot_estimated.yaw_rad - s.robot_true.yaw_rad), dt_s);
    }
    if (s.target_estimate && s.person_true && !s.wrong_person) {
      person.add((*s.target_estimate - *s.person_true).norm(), dt_s);
    }
  }
  const double not_seeking_s = sum.elapsed_s - sum.seek_s;
  if (not_seeking_s > 1e-9) sum.moving_speed_mps = sum.distance_m / not_seeking_s;
  if (driven_s > 0.0) sum.driving_speed_mps = driven_m / driven_s;
  sum.position_rms_m = position.root();
  sum.yaw_rms_rad = yaw.root();
  sum.person_error_rms_m = person.root();
  sum.command_off_mps = forward.root();
  sum.command_off_radps = turn.root();
  if (pictures > 0) sum.candidate_share = candidates / pictures;
  sum.latency_median_s = shareOf(log.latencies_s, 0.5);
  sum.latency_p95_s = shareOf(log.latencies_s, 0.95);
  return sum;
}

double shareOf(std::vector<double> values, double share) {
  if (values.empty()) return kNotKnown;
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

nlohmann::ordered_json followJson(const FollowLog& log, const FollowSummary& sum) {
  nlohmann::ordered_json json;
  json["scene"] = log.scene;
  json["seed"] = log.seed;
  json["plan"] = log.plan;
  json["complete"] = sum.outcome != kStoppedRun;
  json["outcome"] = sum.outcome;
  json["distance_m"] = numberOrNull(sum.distance_m, 3);
  json["elapsed_s"] = numberOrNull(sum.elapsed_s, 3);
  json["seek_s"] = numberOrNull(sum.seek_s, 3);
  json["seek_share"] = numberOrNull(sum.seekShare(), 4);
  json["moving_speed_mps"] = numberOrNull(sum.moving_speed_mps, 4);
  json["driving_speed_mps"] = numberOrNull(sum.driving_speed_mps, 4);
  if (log.hasTruth()) {
    json["contacts"] = sum.contacts;
    json["contacts_by_robot"] = sum.contacts_by_robot;
    json["contacts_by_people"] = sum.contactsByPeople();
    json["wrong_person_s"] = numberOrNull(sum.wrong_person_s, 3);
    json["near_others_s"] = numberOrNull(sum.near_others_s, 3);
  }
  json["min_clearance_m"] = numberOrNull(sum.min_clearance_m, 3);
  json["losses"] = sum.losses;
  json["with_target_s"] = numberOrNull(sum.with_target_s, 3);
  json["best_distance_m"] = numberOrNull(sum.best_distance_m, 3);
  json["last_distance_m"] = numberOrNull(sum.last_distance_m, 3);
  json["learn_s"] = numberOrNull(sum.learn_s, 3);
  json["localized_s"] = numberOrNull(sum.localized_s, 3);
  json["position_rms_m"] = numberOrNull(sum.position_rms_m, 4);
  json["yaw_rms_deg"] = numberOrNull(sum.yaw_rms_rad * 180.0 / M_PI, 3);
  json["person_error_rms_m"] = numberOrNull(sum.person_error_rms_m, 4);
  if (log.is_shadow) {
    json["command_off_mps"] = numberOrNull(sum.command_off_mps, 4);
    json["command_off_radps"] = numberOrNull(sum.command_off_radps, 4);
  }
  if (log.is_live) {
    json["latency_median_s"] = numberOrNull(sum.latency_median_s, 4);
    json["latency_p95_s"] = numberOrNull(sum.latency_p95_s, 4);
  }
  json["candidate_share"] = numberOrNull(sum.candidate_share, 4);
  return json;
}

void writeFollowFiles(const Output& output, const FollowLog& log, const FollowSummary& summary) {
  CsvWriter csv = followCsv(output / "follow.csv");
  CsvWriter timing(output / "timing.csv", {"stage", "mean_ms", "median_ms", "p95_ms"});
  addRows(csv, log);
  const auto addTime = [&](const StageTime& time) {
    timing.text(time.name).number(time.mean_ms, 3).number(time.median_ms, 3);
    timing.number(time.p95_ms, 3).endRow();
  };
  std::for_each(log.stages.begin(), log.stages.end(), addTime);
  if (!log.stages.empty()) addTime(log.step);
  csv.close();
  timing.close();
  writeJson(output / "summary.json", followJson(log, summary));
}

}  // namespace heel
