// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The ways in which a run can end, and the signals that ask it to.
#pragma once

#include <stdexcept>

namespace heel {

/// What the command ends with, the same for all verbs.
enum class ExitCode {
  kDone = 0,
  kFault = 1,         ///< Ours or the machine's: results can't be written, memory is short.
  kUsage = 2,         ///< The call makes no sense, or its results may not go where it says.
  kBadInput = 3,      ///< A file that is read is missing or broken.
  kNothingFound = 4,  ///< All went well, but what was looked for is not there.
  kStopped = 130,     ///< By a signal; what was done until then is written, marked incomplete.
};

/// Results can't be written; one sentence. (A call that may not write there at all is a
/// std::invalid_argument.)
struct OutputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What was looked for is not there; one sentence.
struct NothingFound : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A signal ended the work; the sentence tells what is written.
struct Stopped : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// From here on SIGINT, SIGTERM and SIGHUP end the process with ExitCode::kStopped: at once, or, if
/// there are results to keep, the first one only asks the run to end, and the second one ends it at
/// once. Signals that are ignored, as under nohup, stay ignored.
void endOnSignals();

/// Tells that there are results to keep.
void keepResultsOnSignals();

/// Whether a signal asked the run to end: what loops for long asks at every turn.
bool isStopRequested();

}  // namespace heel
