// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Tables as comma-separated text, the same bytes on every run.
#pragma once

#include <heel/apps/output/output.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace heel {

/// `value` with so many decimals, whatever the locale; never "-0.000", and "" if it is not finite.
std::string fixedText(double value, int decimals);

/// A field of a table: quoted, if it has to be.
std::string csvText(std::string_view value);

/// Writes a table row by row.
class CsvWriter {
 public:
  /// @throws OutputError  as OutputFile; so do the others.
  CsvWriter(const OutputPath& path, const std::vector<std::string>& columns);

  /// Starts a field of the current row. Text is quoted where it has to be.
  CsvWriter& text(std::string_view value);
  CsvWriter& integer(std::int64_t value);
  CsvWriter& number(double value, int decimals);  ///< Empty if not finite.
  CsvWriter& flag(bool value);                    ///< 1 or 0.

  /// Ends the row.
  /// @throws std::logic_error  if it has not a field for every column.
  void endRow();

  /// Ends the table.
  void close() { file_.close(); }

 private:
  void field(std::string_view raw);

  OutputFile file_;
  std::size_t columns_;
  std::size_t fields_ = 0;
  std::string row_;
};

/// Reads a table row by row. All errors are std::runtime_error with one sentence that names the
/// file, the line and the column.
class CsvReader {
 public:
  /// Reads the header, in which all of `columns` must be; they may stand in any order, and among
  /// others. Those named in `optional` count on after them; has() tells whether they are there.
  CsvReader(const std::filesystem::path& path, const std::vector<std::string>& columns,
            const std::vector<std::string>& optional = {});

  /// Goes to the next row; false at the end. Blank lines are passed over.
  bool next();

  bool has(std::size_t i) const { return places_[i] != kNowhere; }

  /// The row's value in the column `columns[i]` that the constructor was given.
  const std::string& text(std::size_t i) const { return fields_[places_[i]]; }
  double number(std::size_t i) const;  ///< A finite number.
  std::int64_t integer(std::size_t i) const;
  std::size_t count(std::size_t i) const;  ///< A whole number from 1.
  bool flag(std::size_t i) const;          ///< 1 or 0.

 private:
  static constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);
  [[noreturn]] void fail(const std::string& why) const;
  [[noreturn]] void failAt(std::size_t i, const char* wanted) const;
  bool readLine();

  std::string path_;
  std::ifstream in_;
  std::vector<std::string> columns_;
  std::vector<std::size_t> places_;  ///< Where the wanted columns stand.
  std::size_t width_ = 0;
  std::size_t line_number_ = 0;
  std::string line_;
  std::vector<std::string> fields_;
};

}  // namespace heel
