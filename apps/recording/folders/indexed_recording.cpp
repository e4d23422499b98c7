// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/folders/indexed_recording.hpp>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace heel {

IndexedRecording::IndexedRecording(const std::filesystem::path& path, RecordingInfo info,
                                   std::vector<double> stamps_s)
    : path_(path), order_(std::move(stamps_s)), end_index_(order_.size()) {
  info_ = std::move(info);
  info_.name = std::filesystem::canonical(path).filename().string();
  info_.frame_count = order_.size();
  info_.first_s = order_.first_s();
  info_.duration_s = order_.duration_s();
}

void IndexedRecording::limitTo(const TimeSpan& span) {
  const double first_s = info_.first_s + span.from_s - kSameTime_s;
  const double last_s = info_.first_s + span.to_s + kSameTime_s;
  double before_s = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const double stamp_s = order_.stamp_s(i);
    if (order_.isAhead(i) || stamp_s <= before_s) continue;  // it does not count
    if (stamp_s > last_s) {
      end_index_ = i;
      break;
    }
    if (stamp_s >= first_s && before_s < first_s && span.from_s > 0.0) next_index_ = i;
    before_s = stamp_s;
  }
  if (before_s < first_s) next_index_ = end_index_;
  info_.frame_count = end_index_ - next_index_;
  info_.first_s += std::min(span.from_s, info_.duration_s);
  info_.duration_s = std::max(0.0, std::min(span.to_s, info_.duration_s) - span.from_s);
}

bool IndexedRecording::next(Frame& frame) {
  while (next_index_ < end_index_) {
    const std::size_t index = next_index_++;
    try {
      checkStamp(index);
      read(index, frame);
    } catch (const std::runtime_error& error) {
      skipped_.push_back({index + 1, error.what()});
      continue;
    }
    frame.number = index + 1;
    frame.stamp_s = order_.stamp_s(index);
    frame.name = frameName(index);
    return true;
  }
  return false;
}

// Times that are made up join nothing.
std::optional<RobotMotion> IndexedRecording::readMotion() const {
  if (info_.nominal_stamps || !std::filesystem::is_directory(path_)) return std::nullopt;
  return readFolderMotion(path_);
}

void IndexedRecording::checkStamp(std::size_t index) {
  try {
    order_.check(index);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(frameName(index) + ": " + error.what());
  }
}

namespace fs = std::filesystem;

namespace {

/// Takes the number that `text` starts with, without its leading zeros.
std::string_view takeNumber(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of('0'), text.size()));
  const std::string_view number = text.substr(0, text.find_first_not_of("0123456789"));
  text.remove_prefix(number.size());
  return number;
}

bool startsWithDigit(std::string_view text) {
  return !text.empty() && text.front() >= '0' && text.front() <= '9';
}

}  // namespace

bool isBeforeByNumber(std::string_view a, std::string_view b) {
  const std::string_view whole_a = a, whole_b = b;
  while (!a.empty() && !b.empty()) {
    if (startsWithDigit(a) && startsWithDigit(b)) {
      const std::string_view number_a = takeNumber(a), number_b = takeNumber(b);
      if (number_a.size() != number_b.size()) return number_a.size() < number_b.size();
      if (number_a != number_b) return number_a < number_b;
    } else {
      if (a.front() != b.front()) return a.front() < b.front();
      a.remove_prefix(1);
      b.remove_prefix(1);
    }
  }
  if (a.empty() != b.empty()) return a.empty();
  return whole_a < whole_b;  // the same but for leading zeros
}

std::vector<fs::path> filesIn(const fs::path& folder,
                              const std::function<bool(const fs::path&)>& takes) {
  std::vector<fs::path> files;
  if (!fs::is_directory(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const bool is_hidden = entry.path().filename().native().front() == '.';
    if (!is_hidden && !entry.is_directory() && takes(entry.path())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return isBeforeByNumber(a.filename().native(), b.filename().native());
  });
  return files;
}

}  // namespace heel
