// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// When the files of a recording were taken: lists of stamps, and stamps in file names.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace heel {

/// A file and its time.
struct StampedFile {
  double stamp_s = 0.0;
  std::filesystem::path path;
};

/// Reads a list of the TUM layout: lines "stamp filename", "# " comments; names count from the
/// list's own folder. Stamps are seconds; whole numbers of 13, 16 or 19 digits are milli-, micro-
/// or nanoseconds.
/// @throws std::runtime_error  if it can't be read, holds no file, or a line is not of this form.
std::vector<StampedFile> readStampedFiles(const std::filesystem::path& list);

/// Reads a list of times, one a line (KITTI's times.txt).
/// @throws std::runtime_error  as above.
std::vector<double> readTimes(const std::filesystem::path& list);

/// Reads a table of numbers, separated by commas or blanks; a first line that does not begin with a
/// number is a header.
/// @param form  How a line is written, for messages: "stamp_s,x_m,y_m".
/// @return rows of at least `columns` numbers.
/// @throws std::runtime_error  as above.
std::vector<std::vector<double>> readRows(const std::filesystem::path& table, std::size_t columns,
                                          const std::string& form);

/// For each of `files`, which of `others` is the nearest in time; absent where that is more than
/// `limit_s` away. `others` may be in any order.
std::vector<std::optional<std::size_t>> nearestInTime(const std::vector<StampedFile>& files,
                                                      const std::vector<StampedFile>& others,
                                                      double limit_s);

/// The time that a file's name tells: seconds with a decimal point ("1305031102.175304.png"), or
/// 13, 16 or 19 digits. Absent for any other name.
std::optional<double> stampOfName(const std::filesystem::path& file);

/// The times of files: from the list `times` (see readTimes) if that file exists, else from the
/// names if they tell any, else at `rate_hz` from 0.
/// @param nominal  Out: whether the rate was used.
/// @throws std::runtime_error  if the list has not one time for each of the files, or only some
///         names tell one.
std::vector<double> stampsOfFiles(const std::filesystem::path& times,
                                  const std::vector<std::filesystem::path>& files, double rate_hz,
                                  bool& nominal);

}  // namespace heel
