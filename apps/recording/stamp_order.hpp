// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Which frames of a recording have times that can be.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace heel {

/// Whether a frame's time is after that of the one before that counts; else a sentence says why
/// not.
/// @throws std::runtime_error  if it is not.
void checkGoesOn(double stamp_s, double last_s);

/// @throws std::runtime_error  one sentence, if more than one of the frames that follow, and most
/// of
///         them, would be lost after this one.
void checkIsNotAhead(double stamp_s, double last_s, const std::vector<double>& following_s);

/// The times of a recording's frames, in their order. A frame counts if its time is after that of
/// the one before that counts, and most of the frames that follow are not before it.
class StampOrder {
 public:
  StampOrder() = default;
  explicit StampOrder(std::vector<double> stamps_s);

  std::size_t size() const { return stamps_s_.size(); }
  double stamp_s(std::size_t index) const { return stamps_s_[index]; }

  /// Of the frames that count: the first, from it to the last, and how many a second; 0 if unknown.
  double first_s() const { return first_s_; }
  double duration_s() const { return duration_s_; }
  double rate_hz() const;

  /// Whether its time is wrong, for most of the frames that follow would be lost after it.
  bool isAhead(std::size_t index) const { return is_ahead_[index]; }

  /// Called for each frame in its turn.
  /// @throws std::runtime_error  if it does not count: one sentence.
  void check(std::size_t index);

 private:
  bool wouldLoseNext(std::size_t index, double last_s) const;

  std::vector<double> stamps_s_;
  std::vector<bool> is_ahead_;
  std::size_t count_ = 0;  ///< Frames that count.
  double first_s_ = 0.0;
  double duration_s_ = 0.0;
  double last_s_ = -std::numeric_limits<double>::infinity();  ///< That was checked, and counts.
};

}  // namespace heel
