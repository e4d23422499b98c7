// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What goes to the terminal: names in files may hold what commands it.
#pragma once

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

}  // namespace heel
