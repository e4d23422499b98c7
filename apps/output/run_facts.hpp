// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What a run was called with, and what it took of the machine.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace heel {

/// What inputs are like now, as a JSON array: `inputs` below.
std::string stateOfInputs(const std::vector<std::filesystem::path>& inputs);

/// The facts of this process so far, a JSON object on one line:
///  - `heel`: the version;
///  - `call`: its words;
///  - `inputs`: of each, when the run began, `path`, `bytes`, and `changed_ns`, when it was last
///    written to;
///  - `host`, `cores`: the machine's name, and how many processors it has;
///  - `began`: UTC, as 2026-11-23T08:07:03Z;
///  - `wall_s`, `cpu_s`: the time since then, and that of the processors;
///  - `peak_memory_mib`: the most memory that was in use at a time.
std::string factsOfThisRun(const std::string& inputs);

/// Whether this process was called as that run was, and would read the same. How it is done (with
/// how many threads, how progress is shown) does not count. An input is the same while its size and
/// time are; of a folder, those of all that is in it.
/// @param facts  As factsOfThisRun() gave them; anything else is no repetition.
bool wouldRepeat(const std::string& facts);

}  // namespace heel
