// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What goes to the terminal. Names in files may hold what commands it.
#pragma once

#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

namespace heel {

/// '?' for each control character but line feeds and tabs; letters of all scripts stay. Texts may
/// come in pieces.
class TerminalText {
 public:
  std::string operator()(std::string_view text);

 private:
  unsigned char before_ = 0;
};

/// A sentence that stays on its line.
std::string sentenceForTerminal(std::string_view text);

/// Writes "heel: SENTENCE" on stderr, on a line of its own.
void tell(const std::string& sentence);

/// Lets nothing but such texts through to stdout, as long as it lives.
class TerminalOutput {
 public:
  TerminalOutput();
  ~TerminalOutput();
  TerminalOutput(const TerminalOutput&) = delete;
  TerminalOutput& operator=(const TerminalOutput&) = delete;

 private:
  TerminalText text_;
  std::FILE* const stdout_;
};

/// How far a job is: a bar that is drawn over itself on a terminal, and else a line at every tenth,
/// so that logs stay short; or for programs, at every hundredth a line with a JSON object:
/// {"progress": "following", "done": 12, "of": 120}.
enum class ProgressStyle { kForPeople, kJson };
/// From here on, for the whole process.
void setProgressStyle(ProgressStyle style);

/// Tells on the console how far a job is.
class ProgressBar {
 public:
  /// @param total  How many steps there will be; with 0 nothing is shown.
  explicit ProgressBar(std::string title, std::size_t total, std::FILE* out = stderr);
  ~ProgressBar();  ///< Ends the terminal's line, if nothing that was written meanwhile did.
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
