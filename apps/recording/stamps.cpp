// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/stamps.hpp>
#include <heel/cloud/files.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace heel {

namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// A finite number that fills the whole text.
std::optional<double> numberOf(std::string_view text) {
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// A time in seconds, or of 13, 16 or 19 digits: milli-, micro- or nanoseconds since 1970.
std::optional<double> stampOf(std::string_view text) {
  const std::size_t digits = text.size();
  if (!std::all_of(text.begin(), text.end(), isDigit) ||
      (digits != 13 && digits != 16 && digits != 19)) {
    return numberOf(text);
  }
  // Seconds and the rest apart: as one double, nanoseconds since 1970 would be rounded first.
  const double second = std::pow(10.0, static_cast<double>(digits) - 10.0);
  return *numberOf(text.substr(0, 10)) + *numberOf(text.substr(10)) / second;
}

std::string_view trimmed(std::string_view text) {
  const char* const kBlank = " \t\r";
  const auto first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

/// Calls `take` for each line that is neither blank nor a comment; it says whether it understood.
void forEachLine(const std::filesystem::path& list, const std::string& form,
                 const std::function<bool(std::string_view)>& take) {
  checkIsFile(list);
  std::ifstream in(list);
  if (!in) throw std::runtime_error(list.string() + " cannot be read");
  std::string line;
  std::size_t taken = 0;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    if (number == 1 && line.rfind("\xEF\xBB\xBF", 0) == 0) line.erase(0, 3);  // an editor's mark
    const std::string_view text = trimmed(line);
    if (text.empty() || text.front() == '#') continue;
    if (!take(text)) {
      throw std::runtime_error(list.string() + ", line " + std::to_string(number) + ": '" +
                               std::string(text.substr(0, 60)) + "' is not of the form '" + form +
                               "'");
    }
    ++taken;
  }
  if (in.bad()) throw std::runtime_error(list.string() + " cannot be read to its end");
  if (taken == 0) throw std::runtime_error(list.string() + " lists nothing");
}

}  // namespace

std::vector<StampedFile> readStampedFiles(const std::filesystem::path& list) {
  std::vector<StampedFile> files;
  const std::filesystem::path folder = list.parent_path();
  forEachLine(list, "stamp filename", [&](std::string_view text) {
    const auto gap = text.find_first_of(" \t,");
    if (gap == std::string_view::npos) return false;
    const auto stamp_s = stampOf(text.substr(0, gap));
    const std::string_view name = trimmed(text.substr(gap + 1));
    if (!stamp_s || name.empty()) return false;
    files.push_back({*stamp_s, folder / name});
    return true;
  });
  return files;
}

std::vector<double> readTimes(const std::filesystem::path& list) {
  std::vector<double> stamps_s;
  forEachLine(list, "seconds", [&](std::string_view text) {
    const auto stamp_s = stampOf(text);
    if (stamp_s) stamps_s.push_back(*stamp_s);
    return stamp_s.has_value();
  });
  return stamps_s;
}

std::vector<std::vector<double>> readRows(const std::filesystem::path& table, std::size_t columns,
                                          const std::string& form) {
  std::vector<std::vector<double>> rows;
  bool is_first = true;
  forEachLine(table, form, [&](std::string_view text) {
    std::vector<double> row;
    const bool may_be_header = std::exchange(is_first, false);
    while (!text.empty()) {
      const auto end = std::min(text.find_first_of(" \t,"), text.size());
      const auto number = numberOf(text.substr(0, end));
      if (!number) return may_be_header && row.empty();
      row.push_back(*number);
      text = trimmed(text.substr(std::min(end + 1, text.size())));
    }
    if (row.size() < columns) return false;
    rows.push_back(std::move(row));
    return true;
  });
  if (rows.empty()) throw std::runtime_error(table.string() + " lists nothing");
  return rows;
}

std::vector<std::optional<std::size_t>> nearestInTime(const std::vector<StampedFile>& files,
                                                      const std::vector<StampedFile>& others,
                                                      double limit_s) {
  std::vector<std::size_t> by_time(others.size());
  std::iota(by_time.begin(), by_time.end(), std::size_t{0});
  std::stable_sort(by_time.begin(), by_time.end(), [&](std::size_t a, std::size_t b) {
    return others[a].stamp_s < others[b].stamp_s;
  });
  std::vector<std::optional<std::size_t>> nearest(files.size());
  for (std::size_t i = 0; i < files.size(); ++i) {
    const double stamp_s = files[i].stamp_s;
    const auto after =
        std::lower_bound(by_time.begin(), by_time.end(), stamp_s,
                         [&](std::size_t k, double t) { return others[k].stamp_s < t; });
    double best_s = limit_s;
    const auto consider = [&](std::size_t k) {
      const double apart_s = std::abs(others[k].stamp_s - stamp_s);
      if (apart_s > best_s) return;
      best_s = apart_s;
      nearest[i] = k;
    };
    if (after != by_time.end()) consider(*after);
    if (after != by_time.begin()) consider(*(after - 1));
  }
  return nearest;
}

std::optional<double> stampOfName(const std::filesystem::path& file) {
  const std::string stem = file.stem().string();
  if (stem.empty() || !isDigit(stem.front())) return std::nullopt;
  const bool is_number = stem.find('.') == std::string::npos;  // of the file, unless it is long
  return is_number && stem.size() < 13 ? std::nullopt : stampOf(stem);
}

std::vector<double> stampsOfFiles(const std::filesystem::path& times,
                                  const std::vector<std::filesystem::path>& files, double rate_hz,
                                  bool& nominal) {
  nominal = false;
  std::vector<double> stamps_s;
  if (std::filesystem::exists(times)) {
    stamps_s = readTimes(times);
    if (stamps_s.size() != files.size()) {
      throw std::runtime_error(times.string() + " lists " + std::to_string(stamps_s.size()) +
                               " times for " + std::to_string(files.size()) + " files");
    }
    return stamps_s;
  }
  const auto tellsTime = [](const auto& file) { return stampOfName(file).has_value(); };
  const auto with = std::find_if(files.begin(), files.end(), tellsTime);
  const auto without = std::find_if_not(files.begin(), files.end(), tellsTime);
  nominal = with == files.end();
  if (!nominal && without != files.end()) {
    throw std::runtime_error(without->string() + ": its name tells no time, as that of " +
                             with->filename().string() +
                             " does; take it away, or list the times in " + times.string());
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    stamps_s.push_back(nominal ? static_cast<double>(i) / rate_hz : *stampOfName(files[i]));
  }
  return stamps_s;
}

}  // namespace heel
