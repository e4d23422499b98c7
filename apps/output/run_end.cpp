// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/output/run_end.hpp>

#include <unistd.h>

#include <csignal>

namespace heel {
namespace {

enum : std::sig_atomic_t { kNothingToLose, kHasResults, kStopRequested };

volatile std::sig_atomic_t state = kNothingToLose;

extern "C" void onSignal(int) {
  if (state != kHasResults) {
    constexpr char kText[] = "heel: stopped\n";
    [[maybe_unused]] const auto written = write(STDERR_FILENO, kText, sizeof kText - 1);
    _exit(static_cast<int>(ExitCode::kStopped));
  }
  state = kStopRequested;
  // Ctrl-C also ends who reads from our pipe, and we would die of writing to it.
  std::signal(SIGPIPE, SIG_IGN);
}

}  // namespace

void endOnSignals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    if (std::signal(signal, onSignal) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
}

void keepResultsOnSignals() {
  if (state == kNothingToLose) state = kHasResults;
}

bool isStopRequested() { return state == kStopRequested; }

}  // namespace heel
