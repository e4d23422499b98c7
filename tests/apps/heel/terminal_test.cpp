// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/shared/terminal.hpp>

#include <gtest/gtest.h>

namespace heel {
namespace {

TEST(TerminalText, LetsNoControlCharacterThrough) {
  EXPECT_EQ(TerminalText()("a\x1b[31mred\a\r\x7f\n\tb"), "a?[31mred???\n\tb");
  EXPECT_EQ(TerminalText()(std::string_view("\0\x9b", 2)), "??");
  EXPECT_EQ(TerminalText()("\xc2\x9b"), "\xc2?") << "the same control, in UTF-8";
}

TEST(TerminalText, KeepsLettersOfAllScriptsEvenInPieces) {
  const std::string names = "Käthe 李娜 Ştefan";
  EXPECT_EQ(TerminalText()(names), names);
  TerminalText text;
  std::string pieces;
  for (const char c : names) pieces += text({&c, 1});
  EXPECT_EQ(pieces, names);
}

TEST(TerminalText, OfASentenceStaysOnItsLine) {
  EXPECT_EQ(sentenceForTerminal("a\nb\x1b"), "a b?");
}

}  // namespace
}  // namespace heel
