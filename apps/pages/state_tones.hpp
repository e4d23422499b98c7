// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// How the states of the behaviour are named and coloured on pages and in films.
#pragma once

#include <opencv2/core/types.hpp>

#include <string>
#include <vector>

namespace heel {

/// A state's name as words: "goToLastSeen" is "go to last seen".
std::string wordsOf(const std::string& state);

/// The tones of states on one page: those of the shipped plans have their own, others get the next
/// of a few more.
class StateTones {
 public:
  /// Name of the tone's variable in page.css, for instance "--s-follow".
  std::string of(const std::string& state);

  /// All states that were asked for, in that order.
  const std::vector<std::string>& states() const { return states_; }

 private:
  std::vector<std::string> states_;
  std::vector<std::string> tones_;
  std::size_t others_ = 0;
};

}  // namespace heel
