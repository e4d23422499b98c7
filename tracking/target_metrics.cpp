// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/tracking/target_metrics.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace heel {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

double nearestOther(const TargetFrame& frame) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector2d& other : frame.others_m) {
    nearest = std::min(nearest, (other - *frame.estimate_m).norm());
  }
  return nearest;
}

/// Measures the delays; fed frame by frame.
class ReacquisitionClock {
 public:
  explicit ReacquisitionClock(TargetMetrics& metrics) : metrics_(metrics) {}

  void see(double stamp_s, bool in_view, bool right) {
    const bool came_back = in_view && !was_in_view_;
    const bool went_off = in_view && was_right_ && !right;
    if (ever_right_ && (came_back || went_off)) {
      waiting_ = true;
      since_s_ = stamp_s;
    }
    if (!in_view && waiting_) {
      ++metrics_.not_reacquired;
      waiting_ = false;
    }
    if (right && waiting_) {
      metrics_.reacquisition_delays_s.push_back(stamp_s - since_s_);
      waiting_ = false;
    }
    ever_right_ = ever_right_ || right;
    was_in_view_ = in_view;
    was_right_ = right;
  }

  void finish() {
    if (waiting_) {
      ++metrics_.not_reacquired;
    }
  }

 private:
  TargetMetrics& metrics_;
  bool waiting_ = false;
  double since_s_ = 0.0;
  bool ever_right_ = false;
  bool was_in_view_ = false;
  bool was_right_ = false;
};

}  // namespace

EstimateOf judge(const TargetFrame& frame, double match_distance_m) {
  if (!(match_distance_m > 0.0)) {
    throw std::invalid_argument("judge: the matching distance must be positive");
  }
  if (!frame.estimate_m) {
    return EstimateOf::kNone;
  }
  if (frame.target_m && (*frame.target_m - *frame.estimate_m).norm() <= match_distance_m) {
    return EstimateOf::kTarget;
  }
  return nearestOther(frame) <= match_distance_m ? EstimateOf::kWrongPerson : EstimateOf::kNobody;
}

void Reliability::add(double probability, bool is_so) {
  if (!(probability >= 0.0 && probability <= 1.0)) {
    throw std::invalid_argument("Reliability: a probability is not in [0, 1]");
  }
  const auto last = bins.size() - 1;
  Bin& bin = bins[std::min(static_cast<std::size_t>(probability * 10.0), last)];
  ++bin.count;
  bin.right += is_so ? 1 : 0;
  bin.said += probability;
}

void Reliability::add(const Reliability& other) {
  for (std::size_t i = 0; i < bins.size(); ++i) {
    bins[i].count += other.bins[i].count;
    bins[i].right += other.bins[i].right;
    bins[i].said += other.bins[i].said;
  }
}

double Reliability::expectedError() const {
  double off = 0.0;
  int count = 0;
  for (const Bin& bin : bins) {
    off += std::abs(bin.said - bin.right);
    count += bin.count;
  }
  return count == 0 ? kNothing : off / count;
}

double Reliability::errorByChance() const {
  double off = 0.0;
  int count = 0;
  for (const Bin& bin : bins) {
    count += bin.count;
    const double n = bin.count, p = bin.said / std::max(n, 1.0);
    if (!(p > 0.0 && p < 1.0)) continue;
    // The mean deviation of a binomial distribution (de Moivre).
    const double k = std::floor(n * p) + 1.0;
    off +=
        2.0 * std::exp(std::log(k) + std::lgamma(n + 1.0) - std::lgamma(k + 1.0) -
                       std::lgamma(n - k + 1.0) + k * std::log(p) + (n - k + 1.0) * std::log1p(-p));
  }
  return count == 0 ? kNothing : off / count;
}

TargetMetrics targetMetrics(const std::vector<TargetFrame>& frames, double match_distance_m) {
  TargetMetrics metrics;
  ReacquisitionClock clock(metrics);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const TargetFrame& frame = frames[i];
    if (i > 0 && !(frame.stamp_s > frames[i - 1].stamp_s)) {
      throw std::invalid_argument("targetMetrics: the stamps must increase");
    }
    const EstimateOf of = judge(frame, match_distance_m);
    const bool in_view = frame.target_m.has_value();
    ++metrics.frames;
    metrics.frames_in_view += in_view ? 1 : 0;
    switch (of) {
      case EstimateOf::kNone:
        metrics.none += in_view ? 1 : 0;
        break;
      case EstimateOf::kTarget: {
        const double error = (*frame.target_m - *frame.estimate_m).norm();
        ++metrics.right;
        metrics.error_sum_m += error;
        metrics.contested += nearestOther(frame) < error ? 1 : 0;
        break;
      }
      case EstimateOf::kWrongPerson:
        ++(in_view ? metrics.wrong_person : metrics.absent_wrong_person);
        metrics.wrong_target_s += i + 1 < frames.size() ? frames[i + 1].stamp_s - frame.stamp_s : 0;
        break;
      case EstimateOf::kNobody:
        ++(in_view ? metrics.nobody : metrics.absent_nobody);
        break;
    }
    if (frame.likeliest_m) {
      const bool is_there =
          in_view && (*frame.target_m - *frame.likeliest_m).norm() <= match_distance_m;
      metrics.reliability.add(frame.probability, is_there);
    }
    clock.see(frame.stamp_s, in_view, of == EstimateOf::kTarget);
  }
  clock.finish();
  if (!frames.empty()) {
    metrics.duration_s = frames.back().stamp_s - frames.front().stamp_s;
  }
  return metrics;
}

void TargetMetrics::add(const TargetMetrics& other) {
  frames += other.frames;
  frames_in_view += other.frames_in_view;
  right += other.right;
  wrong_person += other.wrong_person;
  nobody += other.nobody;
  none += other.none;
  contested += other.contested;
  absent_wrong_person += other.absent_wrong_person;
  absent_nobody += other.absent_nobody;
  error_sum_m += other.error_sum_m;
  reliability.add(other.reliability);
  duration_s += other.duration_s;
  wrong_target_s += other.wrong_target_s;
  reacquisition_delays_s.insert(reacquisition_delays_s.end(), other.reacquisition_delays_s.begin(),
                                other.reacquisition_delays_s.end());
  not_reacquired += other.not_reacquired;
}

double TargetMetrics::recall() const {
  return frames_in_view == 0 ? kNothing : static_cast<double>(right) / frames_in_view;
}

double TargetMetrics::wrongPersonShare() const {
  return frames_in_view == 0 ? kNothing : static_cast<double>(wrong_person) / frames_in_view;
}

double TargetMetrics::claimedShare() const {
  const int absent = frames - frames_in_view;
  const int claimed = absent_wrong_person + absent_nobody;
  return absent == 0 ? kNothing : static_cast<double>(claimed) / absent;
}

double TargetMetrics::rightAnswerShare() const {
  const int silent = frames - frames_in_view - absent_wrong_person - absent_nobody;
  return frames == 0 ? kNothing : static_cast<double>(right + silent) / frames;
}

double TargetMetrics::meanError_m() const { return right == 0 ? kNothing : error_sum_m / right; }

double TargetMetrics::meanReacquisitionDelay_s() const {
  const auto& delays = reacquisition_delays_s;
  return delays.empty() ? kNothing
                        : std::accumulate(delays.begin(), delays.end(), 0.0) /
                              static_cast<double>(delays.size());
}

double TargetMetrics::longestReacquisitionDelay_s() const {
  const auto& delays = reacquisition_delays_s;
  return delays.empty() ? kNothing : *std::max_element(delays.begin(), delays.end());
}

}  // namespace heel
