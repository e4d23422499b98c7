// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Many runs as one table.
#pragma once

#include <heel/apps/output/output.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace heel {

/// A field of a run: a number or a text.
using RunField = std::variant<double, std::string>;

/// What became of one run.
struct RunRow {
  std::string name;               ///< Of its results, without the folders above.
  std::filesystem::path results;  ///< The folder; empty if the run left none.
  int exit_code = 0;              ///< See ExitCode.
  std::string reason;             ///< A sentence, if that is not 0.
  std::vector<std::string> call;  ///< That shows it again; empty: not known.
  std::map<std::string, RunField> fields;

  // What it took, as far as that is known.
  std::string host;
  double wall_s = 0.0;
  double cpu_s = 0.0;
  double peak_memory_mib = 0.0;

  /// A field that is a number; NaN where there is none.
  double number(const std::string& column) const;
};

/// Many runs. The same results give the same table, but for what the runs took.
struct RunTable {
  std::vector<RunRow> runs;          ///< By name.
  std::vector<std::string> columns;  ///< Of all fields, in the order in which results name them.

  /// The columns that hold numbers, and not all the same one.
  std::vector<std::string> figures() const;
};

/// Reads what lies in a folder:
///
/// - NAME/summary.json, whose run may be known more closely by its manifest. A number or text of
///   an object in it becomes the column "object.key"; a list, how many it holds.
/// - NAME.json: {"exit": 3, "reason": "a sentence", "call": ["heel", "track", ...]}, for runs that
///   left no results, too.
/// - NAME.evaluation.json, as 'heel evaluate --out' writes it: columns "evaluation.*".
///
/// A folder that has a summary.json itself is one run. What can't be read is a run that failed,
/// with the reason.
/// @throws std::runtime_error  if a folder can't be read, or there is nothing of that in it.
RunTable readRuns(const std::vector<std::filesystem::path>& folders);

/// Writes a row a run: its name, exit code, reason, and all fields.
/// @throws OutputError  as OutputFile; so does the other.
void writeRunsCsv(const OutputPath& file, const RunTable& table);

/// Writes what each run took, which is in no other result.
void writeMachineCsv(const OutputPath& file, const RunTable& table);

}  // namespace heel
