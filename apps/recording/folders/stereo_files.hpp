// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Which images of a folder are a stereo pair, and when they were taken.
#pragma once

#include <heel/apps/recording/recording.hpp>

#include <filesystem>
#include <optional>
#include <vector>

namespace heel {

/// The left and the right image of one moment; either may be missing.
struct StereoPair {
  std::filesystem::path left;
  std::filesystem::path right;
};

/// The pairs of a folder and their times.
struct StereoFiles {
  std::vector<StereoPair> pairs;
  std::vector<double> stamps_s;
  bool nominal_stamps = false;
};

/// Whether the folder holds left or right images in a known layout: in the folders left and right,
/// image_0 and image_1, image_2 and image_3, or cam0 and cam1 (or "data" in these), or named
/// left* and right*, or im0 and im1.
bool hasStereoImages(const std::filesystem::path& folder);

/// Finds the pairs.
///
/// Images are paired by their names; where no name is common, by the times that the names tell,
/// else in their order. Times come from left.txt and right.txt ("stamp filename", which then say
/// the pairs too), from times.txt, from the names, or from `rate_hz`.
/// @throws std::runtime_error  with one sentence, if one side has no images, or the sides can't be
///         paired.
StereoFiles findStereoFiles(const std::filesystem::path& folder, double rate_hz,
                            double max_stamp_difference_s);

}  // namespace heel
