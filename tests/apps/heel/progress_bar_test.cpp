// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/temp_folder.hpp"
#include <heel/apps/heel/shared/terminal.hpp>

#include <gmock/gmock.h>
#include <pty.h>
#include <unistd.h>

#include <array>

namespace {

using heel::test::readText;
using heel::test::TempFolder;

TEST(ProgressBar, TellsEveryTenthWhereThereIsNoTerminal) {
  const TempFolder folder;
  std::FILE* out = std::fopen((folder / "log").c_str(), "w");
  {
    heel::ProgressBar bar("track", 50, out);
    for (std::size_t done = 1; done <= 60; ++done) bar.show(done);
  }
  std::fclose(out);
  std::string expected;
  for (int k = 0; k <= 10; ++k) {
    expected += "track: " + std::to_string(10 * k) + " % (" + std::to_string(5 * k) + " of 50)\n";
  }
  EXPECT_EQ(readText(folder / "log"), expected);
}

TEST(ProgressBar, IsSilentWithoutATotal) {
  const TempFolder folder;
  std::FILE* out = std::fopen((folder / "log").c_str(), "w");
  heel::ProgressBar("track", 0, out).show(3);
  std::fclose(out);
  EXPECT_EQ(readText(folder / "log"), "");
}

TEST(ProgressBar, IsDrawnOverItselfOnATerminal) {
  int screen = -1, terminal = -1;
  if (openpty(&screen, &terminal, nullptr, nullptr, nullptr) != 0) {
    GTEST_SKIP() << "this machine gives no terminals (is /dev/pts mounted?)";
  }
  std::FILE* out = fdopen(terminal, "w");
  {
    heel::ProgressBar bar("track", 2, out);
    bar.show(1);
  }
  const std::string expected =
      "\rtrack [..............................]   0 % (0 of 2)"
      "\rtrack [###############...............]  50 % (1 of 2)\r\n";
  std::string seen;  // it comes in one piece, or in more
  std::array<char, 1000> piece{};
  for (ssize_t got = 1; got > 0 && seen.size() < expected.size();) {
    got = read(screen, piece.data(), piece.size());
    if (got > 0) seen.append(piece.data(), static_cast<std::size_t>(got));
  }
  EXPECT_EQ(seen, expected);
  std::fclose(out);
  close(screen);
}

}  // namespace
