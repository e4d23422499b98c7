// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/folders/indexed_recording.hpp>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace heel {

IndexedRecording::IndexedRecording(const std::filesystem::path& path, RecordingInfo info,
                                   std::vector<double> stamps_s)
    : path_(path), order_(std::move(stamps_s)), end_index_(order_.size()) {
  info_ = std::move(info);
  info_.name = std::filesystem::canonical(path).filename().string();
  info_.frame_count = order_.size();
  info_.first_s = order_.first_s();
  info_.duration_s = order_.duration_s();
}

void IndexedRecording::limitTo(const TimeSpan& span) {
  const double first_s = info_.first_s + span.from_s - kSameTime_s;
  const double last_s = info_.first_s + span.to_s + kSameTime_s;
  double before_s = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const double stamp_s = order_.stamp_s(i);
    if (order_.isAhead(i) || stamp_s <= before_s) continue;  // it does not count
    if (stamp_s > last_s) {
      end_index_ = i;
      break;
    }
    if (stamp_s >= first_s && before_s < first_s && span.from_s > 0.0) next_index_ = i;
    before_s = stamp_s;
  }
  if (before_s < first_s) next_index_ = end_index_;
  info_.frame_count = end_index_ - next_index_;
  info_.first_s += std::min(span.from_s, info_.duration_s);
  info_.duration_s = std::max(0.0, std::min(span.to_s, info_.duration_s) - span.from_s);
}

bool IndexedRecording::next(Frame& frame) {
  while (next_index_ < end_index_) {
    const std::size_t index = next_index_++;
    try {
      checkStamp(index);
      read(index, frame);
    } catch (const std::runtime_error& error) {
      skipped_.push_back({index + 1, error.what()});
      continue;
    }
    frame.number = index + 1;
    frame.stamp_s = order_.stamp_s(index);
    frame.name = frameName(index);
    return true;
  }
  return false;
}

// Times that are made up join nothing.
std::optional<RobotMotion> IndexedRecording::readMotion() const {
  if (info_.nominal_stamps || !std::filesystem::is_directory(path_)) return std::nullopt;
  return readFolderMotion(path_);
}

void IndexedRecording::checkStamp(std::size_t index) {
  try {
    order_.check(index);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(frameName(index) + ": " + error.what());
  }
}

}  // namespace heel
