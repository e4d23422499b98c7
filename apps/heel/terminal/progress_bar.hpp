// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// How far a long job is.
#pragma once

#include <cstddef>
#include <cstdio>
#include <string>

namespace heel {

/// Tells on the console how far a job is: a bar that is drawn over itself on a terminal, else a
/// line at every tenth, so that logs stay short.
class ProgressBar {
 public:
  /// @param total  How many steps there will be; with 0 nothing is shown.
  explicit ProgressBar(std::string title, std::size_t total, std::FILE* out = stderr);
  ~ProgressBar();  ///< Ends the terminal's line.
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Says that `done` steps of the total are done; more than the total counts as all.
  void show(std::size_t done);

 private:
  void draw(std::size_t done, int percent) const;

  std::string title_;
  std::size_t total_;
  std::FILE* out_;
  bool on_terminal_;
  int shown_percent_ = -1;
};

}  // namespace heel
