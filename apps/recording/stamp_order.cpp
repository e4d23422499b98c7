// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/stamp_order.hpp>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace heel {
namespace {

bool isAheadOf(const std::vector<double>& following_s, double stamp_s, double last_s) {
  std::size_t lost = 0, kept = 0;
  for (const double next_s : following_s) {
    if (next_s > stamp_s) ++kept;
    if (next_s > last_s && next_s < stamp_s) ++lost;
  }
  return lost > 1 && lost > kept;
}

[[noreturn]] void failAhead(double stamp_s) {
  throw std::runtime_error("the time jumps ahead to " + std::to_string(stamp_s) +
                           " s, and the next frames are before it");
}

}  // namespace

void checkGoesOn(double stamp_s, double last_s) {
  if (stamp_s > last_s) return;
  const bool stalls = stamp_s == last_s;
  throw std::runtime_error(std::string("the time ") + (stalls ? "stands still" : "runs backwards") +
                           ", from " + std::to_string(last_s) + " s to " + std::to_string(stamp_s) +
                           " s");
}

void checkIsNotAhead(double stamp_s, double last_s, const std::vector<double>& following_s) {
  if (isAheadOf(following_s, stamp_s, last_s)) failAhead(stamp_s);
}

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
  const auto at = [&](std::size_t i) { return stamps_s_.begin() + static_cast<std::ptrdiff_t>(i); };
  return isAheadOf({at(index + 1), at(end)}, stamps_s_[index], last_s);
}

void StampOrder::check(std::size_t index) {
  const double stamp_s = stamps_s_[index];
  checkGoesOn(stamp_s, last_s_);
  if (isAhead(index)) failAhead(stamp_s);
  last_s_ = stamp_s;
}

}  // namespace heel
