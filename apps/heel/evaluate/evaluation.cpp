// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/evaluate/evaluation.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>

namespace heel {
namespace {

template <typename Row>
void sortByStamp(std::vector<Row>& rows) {
  std::stable_sort(rows.begin(), rows.end(),
                   [](const Row& a, const Row& b) { return a.stamp_s < b.stamp_s; });
}

/// Whom phase 1 would choose: the first person of the truth.
std::string firstPerson(const std::vector<Moment>& moments) {
  for (const Moment& moment : moments) {
    if (!moment.truth.empty()) {
      return moment.truth.front().person;
    }
  }
  throw std::runtime_error("nobody is in the truth at the time of a frame");
}

bool isPerson(const TrackRow& row) { return row.is_target || row.person_probability > 0.5; }

TrackingFrame everyone(const Moment& moment, std::map<std::string, int>& ids) {
  TrackingFrame frame;
  for (const TruthRow& row : moment.truth) {
    const int id = ids.emplace(row.person, static_cast<int>(ids.size())).first->second;
    frame.truth.push_back({id, row.position_m});
  }
  for (const TrackRow& row : moment.tracks) {
    if (isPerson(row)) frame.estimates.push_back({row.track_id, row.position_m});
  }
  return frame;
}

TargetFrame targetOnly(const Moment& moment, const std::string& target) {
  TargetFrame frame;
  frame.stamp_s = moment.stamp_s;
  for (const TruthRow& row : moment.truth) {
    if (row.person == target) {
      frame.target_m = row.position_m;
    } else {
      frame.others_m.push_back(row.position_m);
    }
  }
  for (const TrackRow& row : moment.tracks) {
    if (row.is_target) {
      frame.estimate_m = row.position_m;
    }
  }
  return frame;
}

}  // namespace

std::vector<Moment> alignByStamp(std::vector<TrackRow> tracks, std::vector<TruthRow> truth,
                                 const std::vector<double>& frames_s, double tolerance_s) {
  sortByStamp(tracks);
  sortByStamp(truth);
  std::vector<Moment> moments;
  std::size_t t = 0, p = 0, f = 0;
  while (t < tracks.size() || p < truth.size() || f < frames_s.size()) {
    Moment moment;
    moment.stamp_s = std::numeric_limits<double>::infinity();
    if (t < tracks.size()) moment.stamp_s = tracks[t].stamp_s;
    if (p < truth.size()) moment.stamp_s = std::min(moment.stamp_s, truth[p].stamp_s);
    if (f < frames_s.size()) moment.stamp_s = std::min(moment.stamp_s, frames_s[f]);
    const std::size_t first_frame = f;
    while (f < frames_s.size() && frames_s[f] <= moment.stamp_s + tolerance_s) ++f;
    for (; t < tracks.size() && tracks[t].stamp_s <= moment.stamp_s + tolerance_s; ++t) {
      moment.tracks.push_back(std::move(tracks[t]));
    }
    for (; p < truth.size() && truth[p].stamp_s <= moment.stamp_s + tolerance_s; ++p) {
      moment.truth.push_back(std::move(truth[p]));
    }
    if (frames_s.empty() || f > first_frame) moments.push_back(std::move(moment));
  }
  return moments;
}

Evaluation evaluate(const std::vector<Moment>& moments, const EvaluationParams& params) {
  Evaluation result;
  result.target = params.target.empty() ? firstPerson(moments) : params.target;
  std::vector<TrackingFrame> people;
  std::vector<TargetFrame> person;
  std::map<std::string, int> ids;
  bool target_is_there = false, has_both = false, has_tracks = false;
  for (const Moment& moment : moments) {
    if (moment.stamp_s < params.from_s || moment.stamp_s > params.to_s) {
      continue;
    }
    people.push_back(everyone(moment, ids));
    result.things += static_cast<int>(moment.tracks.size() - people.back().estimates.size());
    has_both = has_both || !(moment.tracks.empty() || moment.truth.empty());
    has_tracks = has_tracks || !moment.tracks.empty();
    person.push_back(targetOnly(moment, result.target));
    target_is_there = target_is_there || person.back().target_m.has_value();
  }
  if (!target_is_there) {
    throw std::runtime_error("there is no '" + result.target + "' in the truth");
  }
  if (has_tracks && !has_both) {
    throw std::runtime_error(
        "no stamp of the tracks is in the truth: they are not of one recording");
  }
  ClearMotParams clear_mot;
  clear_mot.match_distance_m = params.match_distance_m;
  result.people = clearMot(people, clear_mot);
  result.person = targetMetrics(person, params.match_distance_m);
  return result;
}

}  // namespace heel
