// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What all recordings share whose frames are files of their own.
#pragma once

#include <heel/apps/recording/recording.hpp>
#include <heel/apps/recording/stamp_order.hpp>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace heel {

/// A recording whose frames and stamps are known when it is opened.
class IndexedRecording : public Recording {
 public:
  /// Leaves only the frames of a part; call it before the first is read.
  void limitTo(const TimeSpan& span);

  bool next(Frame& frame) final;

  std::optional<RobotMotion> readMotion() const final;

 protected:
  /// Completes `info` with the name of `path`, the number of frames and the duration.
  IndexedRecording(const std::filesystem::path& path, RecordingInfo info,
                   std::vector<double> stamps_s);

  /// The file that frame `index` (from 0) is known by.
  virtual std::string frameName(std::size_t index) const = 0;

  /// Reads frame `index` (from 0); number, stamp and name are filled by the caller.
  /// @throws std::runtime_error  if it can't be read: one sentence that names the file.
  virtual void read(std::size_t index, Frame& frame) = 0;

 private:
  void checkStamp(std::size_t index);

  std::filesystem::path path_;
  StampOrder order_;
  std::size_t next_index_ = 0;
  std::size_t end_index_;
};

/// Whether `a` comes before `b`; digits count as a number, so that "left9" is before "left10".
bool isBeforeByNumber(std::string_view a, std::string_view b);

/// The folder's files whose path `takes` accepts, but for hidden ones, in the order of
/// isBeforeByNumber(); none if there is no such folder.
std::vector<std::filesystem::path> filesIn(
    const std::filesystem::path& folder,
    const std::function<bool(const std::filesystem::path&)>& takes);

}  // namespace heel
