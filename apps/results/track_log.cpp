// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/results/track_log.hpp>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace heel {

TrackSample sampleOf(const FrameRow& frame, const std::vector<TrackRow>& tracks, double pixels) {
  TrackSample sample;
  sample.stamp_s = frame.stamp_s;
  sample.robot = frame.robot;
  sample.state = frame.state;
  sample.reason = frame.reason;
  if (pixels > 0.0) sample.color_share = frame.color_pixels / pixels;
  for (const TrackRow& track : tracks) {
    if (track.is_target) {
      sample.target_m = track.position_m;
      sample.confidence = frame.confidence;
    } else {
      sample.others.push_back({track.track_id, track.position_m, track.status == "confirmed",
                               track.person_probability});
    }
  }
  return sample;
}

namespace {

constexpr double kHalfWidth_m = 0.25;

/// The rows of one moment.
std::vector<TrackRow> tracksAt(const TrackTables& tables, double stamp_s) {
  std::vector<TrackRow> rows;
  std::copy_if(tables.tracks.begin(), tables.tracks.end(), std::back_inserter(rows),
               [&](const TrackRow& row) { return row.stamp_s == stamp_s; });
  return rows;
}

/// Of each track of the next piece, its number in the whole, as far as both had it at that moment.
std::map<int, int> sameTracks(const std::vector<TrackRow>& ours,
                              const std::vector<TrackRow>& theirs) {
  std::vector<std::tuple<double, int, int>> pairs;
  for (const TrackRow& a : ours) {
    for (const TrackRow& b : theirs) {
      const double apart_m = (a.position_m - b.position_m).norm();
      if (apart_m < kHalfWidth_m) pairs.emplace_back(apart_m, a.track_id, b.track_id);
    }
  }
  std::sort(pairs.begin(), pairs.end());  // the nearest first
  std::map<int, int> number_of;
  std::set<int> taken;
  for (const auto& [apart_m, a, b] : pairs) {
    if (taken.count(a) > 0 || number_of.count(b) > 0) continue;
    taken.insert(a);
    number_of[b] = a;
  }
  return number_of;
}

int highestNumber(const TrackTables& tables) {
  int highest = 0;
  for (const TrackRow& row : tables.tracks) highest = std::max(highest, row.track_id);
  return highest;
}

}  // namespace

Seam join(TrackTables& whole, TrackTables next) {
  if (whole.frames.empty() || next.frames.empty()) {
    throw std::invalid_argument("a piece without frames can't be joined");
  }
  const FrameRow last = whole.frames.back();
  const auto begin = std::find_if(next.frames.begin(), next.frames.end(),
                                  [&](const FrameRow& row) { return row.stamp_s > last.stamp_s; });
  if (begin == next.frames.end()) {
    throw std::invalid_argument("a piece ends before the one that it is to follow");
  }
  Seam seam;
  seam.first_frame = begin->frame;
  const bool overlaps = begin != next.frames.begin() && std::prev(begin)->stamp_s == last.stamp_s;
  const auto number = [](std::size_t frame) { return static_cast<std::ptrdiff_t>(frame); };
  if (overlaps) {
    seam.shift = number(last.frame) - number(std::prev(begin)->frame);
  } else {
    seam.shift = std::max<std::ptrdiff_t>(0, number(last.frame) + 1 - number(begin->frame));
  }

  std::map<int, int> number_of;
  if (overlaps) {
    number_of = sameTracks(tracksAt(whole, last.stamp_s), tracksAt(next, last.stamp_s));
  }
  int highest = highestNumber(whole);
  for (TrackRow& row : next.tracks) {
    if (row.stamp_s <= last.stamp_s) continue;
    const auto [place, is_new] = number_of.try_emplace(row.track_id, highest + 1);
    if (is_new) ++highest;
    row.track_id = place->second;
    whole.tracks.push_back(std::move(row));
  }
  for (auto row = begin; row != next.frames.end(); ++row) {
    row->frame = static_cast<std::size_t>(number(row->frame) + seam.shift);
    if (row->target_id != 0) row->target_id = number_of[row->target_id];
    whole.frames.push_back(std::move(*row));
  }
  return seam;
}

}  // namespace heel
