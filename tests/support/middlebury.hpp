// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The real stereo pairs (Scharstein et al., GCPR 2014) and how well disparities agree.
#pragma once

#include <heel/cloud/pinhole_camera.hpp>

#include <opencv2/core/mat.hpp>

#include <array>
#include <filesystem>

namespace heel::test {

constexpr std::array<const char*, 4> kMiddleburyPairs = {"Adirondack", "Motorcycle", "Piano",
                                                         "Teddy"};

struct MiddleburyPair {
  cv::Mat left, right;   ///< CV_8UC3.
  cv::Mat1f disparity;   ///< Truth; inf where it is not known.
  cv::Mat1b seen_twice;  ///< 255 where both cameras see the point.
  StereoCamera camera;
  int disparities = 0;  ///< What a matcher should try.
};

MiddleburyPair readMiddleburyPair(const std::filesystem::path& folder);

/// Disparities against the truth, over the pixels that are seen twice.
struct MatchQuality {
  double density = 0.0;       ///< Share of them that have a disparity.
  double bad2_percent = 0.0;  ///< Of these, how many are off by more than 2 px.
  double median_depth_error_mm = 0.0;
};
MatchQuality matchQuality(const cv::Mat1f& disparity, const MiddleburyPair& pair);

/// How the disparities of some pixels agree with a reference.
struct Agreement {
  int pixels = 0;     ///< Where the region is set.
  int reference = 0;  ///< Of them, how many have a reference.
  int both = 0;       ///< Of these, how many have a disparity, too.
  int within = 0;     ///< Of these, how many differ by no more than the tolerance.
  double withinShare() const { return both > 0 ? static_cast<double>(within) / both : 1.0; }
  double foundShare() const { return reference > 0 ? static_cast<double>(both) / reference : 1.0; }
};
Agreement agreement(const cv::Mat1f& disparity, const cv::Mat1f& reference, const cv::Mat1b& region,
                    double tolerance_px);

}  // namespace heel::test
