// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Parts that Heel's pages share, and the tones of a plan's states.
#pragma once

#include <heel/apps/pictures/annotate.hpp>
#include <heel/apps/results/follow_log.hpp>

#include <opencv2/core/types.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace heel {

/// The tone's class in page.css.
const char* classOf(Tone tone);

/// A headline figure. The texts are put in as they are.
std::string tile(const std::string& name, const std::string& figure, const std::string& note,
                 Tone tone = Tone::kNeutral);

/// A bar of a table: `share` of its width, in [0, 1].
std::string bar(double share, const std::string& of_class = {});

/// A place for the bars of the values that are known, and the middle one of these; histograms.js
/// draws them. The title is put in as it is.
std::string histogram(const std::string& title, std::vector<double> values,
                      const std::string& unit = {});

/// A row of the paper's Table 1. `name` is put in as it is.
/// @param with_bar  Ends with the share of seeking as a bar.
std::string runRow(const std::string& name, const PaperRow& row, const std::string& of_class = {},
                   bool with_bar = false);

/// Milliseconds of each stage and of a whole step, and whether that keeps up with the camera.
std::string timingTable(const std::vector<StageTime>& stages, const StageTime& step,
                        double camera_rate_hz);

/// The command line as a sentence; empty for none.
std::string howToRepeat(const std::string& command);

/// The first elements of a page, up to its own style. The title is put in as it is.
std::string head(const std::string& title, const std::string& style = {});

/// The last elements of a page: uPlot with its licence, and the page's own script.
std::string scripts(const char* script);

/// "once", "twice", "3 times".
std::string timesText(std::size_t count);

/// A state's name as words: "goToLastSeen" is "go to last seen".
std::string wordsOf(const std::string& state);

/// The tones of states on one page: those of the shipped plans have their own, others get the next
/// of a few more.
class StateTones {
 public:
  /// Name of the tone's variable in page.css, for instance "--s-follow".
  std::string of(const std::string& state);

  /// This state has that tone.
  void use(const std::string& state, const std::string& tone);

  /// All states that were asked for, in that order.
  const std::vector<std::string>& states() const { return states_; }

 private:
  std::vector<std::string> states_;
  std::vector<std::string> tones_;
  std::size_t others_ = 0;
};

}  // namespace heel
