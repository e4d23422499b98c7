// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/folders/indexed_recording.hpp>

#include <stdexcept>
#include <utility>

namespace heel {

IndexedRecording::IndexedRecording(const std::filesystem::path& path, RecordingInfo info,
                                   std::vector<double> stamps_s)
    : path_(path), order_(std::move(stamps_s)) {
  info_ = std::move(info);
  info_.name = std::filesystem::canonical(path).filename().string();
  info_.frame_count = order_.size();
  info_.first_s = order_.first_s();
  info_.duration_s = order_.duration_s();
}

bool IndexedRecording::next(Frame& frame) {
  while (next_index_ < order_.size()) {
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

}  // namespace heel
