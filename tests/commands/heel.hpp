// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Runs the built `heel` command, as a shell does.
#pragma once

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace heel::test {

/// What a run of the command left.
struct HeelRun {
  int exit_code = -1;  ///< Meaningless if a signal ended it.
  int signal = 0;      ///< That ended it; 0 if none did.
  std::string out;     ///< What it said.
  std::string err;
  long peak_kB = 0;  ///< Of its resident memory.

  bool succeeded() const { return signal == 0 && exit_code == 0; }

  /// Lines of `err` that say why it failed: neither warnings nor progress.
  std::vector<std::string> errors() const;
  /// Lines of `err` that warn, without "heel: warning: ".
  std::vector<std::string> warnings() const;
};

/// Runs `heel ARGUMENTS`.
/// @param largest_file  No file can grow beyond this many bytes: writing fails, as on a full disk.
HeelRun heel(const std::vector<std::string>& arguments,
             std::optional<std::size_t> largest_file = std::nullopt);

/// The arguments of a call, and more.
std::vector<std::string> joined(std::vector<std::string> call,
                                const std::vector<std::string>& more);

/// Runs `heel ARGUMENTS MORE`.
HeelRun heel(const std::vector<std::string>& arguments, const std::vector<std::string>& more);

/// Runs `heel ARGUMENTS`, and does something once it has said `text` on stderr.
/// @param then  Called with the process, if that has not ended too early.
HeelRun heelUntil(const std::vector<std::string>& arguments, const std::string& text,
                  const std::function<void(pid_t)>& then);

/// The same: sends it these signals, one after the other.
HeelRun heelSignalled(const std::vector<std::string>& arguments, const std::string& text,
                      const std::vector<int>& signals);

/// That it ended well.
testing::AssertionResult succeeds(const HeelRun& run);

/// That it ended well, but found nothing: exit code 4, and one error line.
testing::AssertionResult findsNothing(const HeelRun& run);

/// That it ended well, whether it found anything or not.
testing::AssertionResult endsWell(const HeelRun& run);

/// That it failed as it should: no signal, no result on stdout, and one error line, which starts
/// with "heel: " and has all of `parts` in it.
testing::AssertionResult failsWith(const HeelRun& run, const std::vector<std::string>& parts);

/// What the summary.json of results says.
nlohmann::json summaryIn(const std::filesystem::path& folder);

/// Names of all files below a folder but manifests, hidden ones too, sorted; empty if there is no
/// folder.
std::vector<std::string> filesBelow(const std::filesystem::path& folder);

/// Those, each with a hash of its bytes.
std::map<std::string, std::size_t> contentOf(const std::filesystem::path& folder);

}  // namespace heel::test
