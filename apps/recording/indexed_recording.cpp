// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/recording/indexed_recording.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace heel {

IndexedRecording::IndexedRecording(const std::filesystem::path& path, RecordingInfo info,
                                   std::vector<double> stamps_s)
    : stamps_s_(std::move(stamps_s)) {
  info_ = std::move(info);
  info_.name = std::filesystem::canonical(path).filename().string();
  info_.frame_count = stamps_s_.size();
  double first_s = last_stamp_s_, last_s = last_stamp_s_;  // of the frames that count
  for (std::size_t i = 0; i < stamps_s_.size(); ++i) {
    if (!(stamps_s_[i] > last_s) || isAhead(i, last_s)) continue;
    last_s = stamps_s_[i];
    if (!std::isfinite(first_s)) first_s = last_s;
  }
  if (std::isfinite(first_s)) info_.duration_s = last_s - first_s;
}

bool IndexedRecording::next(Frame& frame) {
  while (next_index_ < stamps_s_.size()) {
    const std::size_t index = next_index_++;
    try {
      checkStamp(index);
      read(index, frame);
    } catch (const std::runtime_error& error) {
      skipped_.push_back({index + 1, error.what()});
      continue;
    }
    frame.number = index + 1;
    frame.stamp_s = stamps_s_[index];
    frame.name = frameName(index);
    return true;
  }
  return false;
}

/// Whether most of the frames that follow would be lost after this one, for their times are before
/// its own: then this one's is wrong.
bool IndexedRecording::isAhead(std::size_t index, double last_s) const {
  constexpr std::size_t kFollowing = 100;
  const std::size_t end = std::min(stamps_s_.size(), index + 1 + kFollowing);
  std::size_t lost = 0, kept = 0;
  for (std::size_t i = index + 1; i < end; ++i) {
    if (stamps_s_[i] > stamps_s_[index]) ++kept;
    if (stamps_s_[i] > last_s && stamps_s_[i] < stamps_s_[index]) ++lost;
  }
  return lost > 1 && lost > kept;
}

void IndexedRecording::checkStamp(std::size_t index) {
  const double stamp_s = stamps_s_[index];
  if (!(stamp_s > last_stamp_s_)) {
    const bool stalls = stamp_s == last_stamp_s_;
    throw std::runtime_error(
        frameName(index) + ": the time " + (stalls ? "stands still" : "runs backwards") +
        ", from " + std::to_string(last_stamp_s_) + " s to " + std::to_string(stamp_s) + " s");
  }
  if (isAhead(index, last_stamp_s_)) {
    throw std::runtime_error(frameName(index) + ": the time jumps ahead to " +
                             std::to_string(stamp_s) + " s, and the next frames are before it");
  }
  last_stamp_s_ = stamp_s;
}

}  // namespace heel
