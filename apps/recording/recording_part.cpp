// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/recording_part.hpp>
#include <heel/apps/recording/time_span.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace heel {

RecordingPart::RecordingPart(std::unique_ptr<Recording> whole, const TimeSpan& span)
    : whole_(std::move(whole)) {
  info_ = whole_->info();
  const double whole_s = info_.duration_s;
  first_s_ = info_.first_s + std::max(span.from_s, 0.0) - kSameTime_s;
  last_s_ = info_.first_s + span.to_s + kSameTime_s;
  info_.first_s += std::min(std::max(span.from_s, 0.0), whole_s);
  info_.duration_s = std::max(0.0, std::min(span.to_s, whole_s) - std::max(span.from_s, 0.0));
  if (whole_s > 0.0 && info_.frame_count > 1) {
    const double steps = static_cast<double>(info_.frame_count - 1) * info_.duration_s / whole_s;
    info_.frame_count = 1 + static_cast<std::size_t>(std::llround(steps));
  }
}

bool RecordingPart::next(Frame& frame) {
  bool is_there = whole_->next(frame);
  while (is_there && frame.stamp_s < first_s_) is_there = whole_->next(frame);
  skipped_ = whole_->skipped();
  return is_there && frame.stamp_s <= last_s_;
}

}  // namespace heel
