// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/stamp_order.hpp>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace heel {

StampOrder::StampOrder(std::vector<double> stamps_s)
    : stamps_s_(std::move(stamps_s)), is_ahead_(stamps_s_.size(), false) {
  double last_s = last_s_;
  for (std::size_t i = 0; i < stamps_s_.size(); ++i) {
    if (!(stamps_s_[i] > last_s)) continue;
    is_ahead_[i] = wouldLoseNext(i, last_s);
    if (is_ahead_[i]) continue;
    last_s = stamps_s_[i];
    if (count_++ == 0) first_s_ = last_s;
  }
  if (count_ > 0) duration_s_ = last_s - first_s_;
}

double StampOrder::rate_hz() const {
  return duration_s_ > 0.0 ? static_cast<double>(count_ - 1) / duration_s_ : 0.0;
}

bool StampOrder::wouldLoseNext(std::size_t index, double last_s) const {
  constexpr std::size_t kFollowing = 100;
  const std::size_t end = std::min(stamps_s_.size(), index + 1 + kFollowing);
  std::size_t lost = 0, kept = 0;
  for (std::size_t i = index + 1; i < end; ++i) {
    if (stamps_s_[i] > stamps_s_[index]) ++kept;
    if (stamps_s_[i] > last_s && stamps_s_[i] < stamps_s_[index]) ++lost;
  }
  return lost > 1 && lost > kept;
}

void StampOrder::check(std::size_t index) {
  const double stamp_s = stamps_s_[index];
  if (!(stamp_s > last_s_)) {
    const bool stalls = stamp_s == last_s_;
    throw std::runtime_error(std::string("the time ") +
                             (stalls ? "stands still" : "runs backwards") + ", from " +
                             std::to_string(last_s_) + " s to " + std::to_string(stamp_s) + " s");
  }
  if (isAhead(index)) {
    throw std::runtime_error("the time jumps ahead to " + std::to_string(stamp_s) +
                             " s, and the next frames are before it");
  }
  last_s_ = stamp_s;
}

}  // namespace heel
