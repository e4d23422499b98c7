// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/output/csv_file.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace heel {

namespace {

/// Splits a line at its commas; a quoted field may hold commas and doubled quotes.
void split(const std::string& line, std::vector<std::string>& fields) {
  fields.assign(1, {});
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"') {
      const bool doubled = quoted && i + 1 < line.size() && line[i + 1] == '"';
      if (doubled) {
        fields.back() += c;
        ++i;
      } else {
        quoted = !quoted;
      }
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
}

std::string withoutBlanks(const std::string& text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

template <typename Number>
bool parseWhole(const std::string& field, Number& value) {
  const std::string text = withoutBlanks(field);
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stop == end;
}

}  // namespace

std::string fixedText(double value, int decimals) {
  if (!std::isfinite(value)) return {};
  std::array<char, 400> buffer{};  // 309 digits before the point, at most
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                 std::chars_format::fixed, std::min(decimals, 60))
                       .ptr;
  std::string text(buffer.data(), end);
  const bool is_zero = text.find_first_of("123456789") == std::string::npos;
  if (is_zero && text.front() == '-') text.erase(0, 1);
  return text;
}

std::string csvText(std::string_view value) {
  if (value.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(value);
  std::string quoted = "\"";
  for (const char c : value) {
    if (c == '"') quoted += '"';
    quoted += c == '\n' || c == '\r' ? ' ' : c;  // a row is a line
  }
  return quoted + '"';
}

CsvWriter::CsvWriter(const OutputPath& path, const std::vector<std::string>& columns)
    : file_(path), columns_(columns.size()) {
  for (const auto& column : columns) text(column);
  endRow();
}

void CsvWriter::field(std::string_view raw) {
  if (fields_++ > 0) row_ += ',';
  row_ += raw;
}

CsvWriter& CsvWriter::text(std::string_view value) {
  field(csvText(value));
  return *this;
}

CsvWriter& CsvWriter::integer(std::int64_t value) {
  field(std::to_string(value));
  return *this;
}

CsvWriter& CsvWriter::number(double value, int decimals) {
  field(fixedText(value, decimals));
  return *this;
}

CsvWriter& CsvWriter::flag(bool value) {
  field(value ? "1" : "0");
  return *this;
}

void CsvWriter::endRow() {
  if (fields_ != columns_) {
    throw std::logic_error("CsvWriter: a row of " + std::to_string(fields_) +
                           " fields in a table of " + std::to_string(columns_) + " columns");
  }
  row_ += '\n';
  file_.write(row_);
  row_.clear();
  fields_ = 0;
}

CsvReader::CsvReader(const std::filesystem::path& path, const std::vector<std::string>& columns,
                     const std::vector<std::string>& optional)
    : path_(path.string()), in_(path), columns_(columns) {
  columns_.insert(columns_.end(), optional.begin(), optional.end());
  if (!in_) throw std::runtime_error(path_ + " cannot be read");
  if (!readLine()) throw std::runtime_error(path_ + " is empty; a header line was expected");
  for (const auto& column : columns_) {
    const auto place = std::find(fields_.begin(), fields_.end(), column);
    const bool is_there = place != fields_.end();
    if (!is_there && places_.size() < columns.size()) {
      fail("the header has no column '" + column + "'");
    }
    places_.push_back(is_there ? static_cast<std::size_t>(place - fields_.begin()) : kNowhere);
  }
  width_ = fields_.size();
}

bool CsvReader::readLine() {
  while (std::getline(in_, line_)) {
    if (++line_number_ == 1 && line_.rfind("\xEF\xBB\xBF", 0) == 0) line_.erase(0, 3);
    if (!line_.empty() && line_.back() == '\r') line_.pop_back();
    if (withoutBlanks(line_).empty()) continue;
    split(line_, fields_);
    return true;
  }
  if (in_.bad()) throw std::runtime_error(path_ + " cannot be read to its end");
  return false;
}

bool CsvReader::next() {
  if (!readLine()) return false;
  if (fields_.size() != width_) {
    fail("there are " + std::to_string(fields_.size()) + " fields, but " + std::to_string(width_) +
         " columns");
  }
  return true;
}

void CsvReader::fail(const std::string& why) const {
  throw std::runtime_error(path_ + ", line " + std::to_string(line_number_) + ": " + why);
}

void CsvReader::failAt(std::size_t i, const char* wanted) const {
  fail(columns_[i] + " is '" + text(i) + "', not " + wanted);
}

double CsvReader::number(std::size_t i) const {
  double value = 0.0;
  if (!parseWhole(text(i), value) || !std::isfinite(value)) failAt(i, "a number");
  return value;
}

std::int64_t CsvReader::integer(std::size_t i) const {
  std::int64_t value = 0;
  if (!parseWhole(text(i), value)) failAt(i, "a whole number");
  return value;
}

std::size_t CsvReader::count(std::size_t i) const {
  const std::int64_t value = integer(i);
  if (value < 1) failAt(i, "a number from 1");
  return static_cast<std::size_t>(value);
}

bool CsvReader::flag(std::size_t i) const {
  const std::string value = withoutBlanks(text(i));
  if (value != "0" && value != "1") failAt(i, "0 or 1");
  return value == "1";
}

}  // namespace heel
