// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/temp_folder.hpp"
#include <heel/apps/heel/shared/terminal.hpp>

#include <gmock/gmock.h>
#include <pty.h>
#include <unistd.h>

#include <array>
#include <optional>
#include <string>

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

/// What `draw(out)` shows on a terminal; absent if this machine gives none.
template <typename Draw>
std::optional<std::string> shownOnTerminal(const Draw& draw) {
  int screen = -1, terminal = -1;
  if (openpty(&screen, &terminal, nullptr, nullptr, nullptr) != 0) return std::nullopt;
  std::FILE* out = fdopen(terminal, "w");
  draw(out);
  std::fputs("end", out);
  std::fflush(out);
  std::string seen;  // it comes in one piece, or in more
  std::array<char, 1000> piece{};
  for (ssize_t got = 1; got > 0 && seen.find("end") == std::string::npos;) {
    got = read(screen, piece.data(), piece.size());
    if (got > 0) seen.append(piece.data(), static_cast<std::size_t>(got));
  }
  std::fclose(out);
  close(screen);
  return seen;
}

constexpr const char* kNoTerminal = "this machine gives no terminals (is /dev/pts mounted?)";
const std::string kBars =
    "\rtrack [..............................]   0 % (0 of 2)"
    "\rtrack [###############...............]  50 % (1 of 2)\r\n";

TEST(ProgressBar, IsDrawnOverItselfOnATerminal) {
  const auto seen =
      shownOnTerminal([](std::FILE* out) { heel::ProgressBar("track", 2, out).show(1); });
  if (!seen) GTEST_SKIP() << kNoTerminal;
  EXPECT_EQ(*seen, kBars + "end");
}

TEST(ProgressBar, EndsItsLineBeforeTheResults) {
  const auto seen = shownOnTerminal([](std::FILE* out) {
    heel::ProgressBar bar("track", 2, out);
    bar.show(1);
    testing::internal::CaptureStdout();
    {
      const heel::TerminalOutput output;
      std::printf("3 frames\n");
    }
    std::fputs(testing::internal::GetCapturedStdout().c_str(), out);
  });
  if (!seen) GTEST_SKIP() << kNoTerminal;
  EXPECT_EQ(*seen, kBars + "3 frames\r\nend") << "and no empty line after them";
}

}  // namespace
