// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Is the camera set up well? Looked at frame by frame, answered in sentences.
#pragma once

#include <heel/cloud/stereo_matcher.hpp>

#include <opencv2/core/mat.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace heel {

/// From when on a figure is a warning.
struct SetupCheckParams {
  double max_gap_s = 1.0;  ///< Warn if more time than this goes by between two frames.
};

/// What was seen so far.
struct SetupReport {
  std::size_t frames = 0;
  double found_share = 0.0;         ///< Mean share of pixels with a depth or disparity.
  double black_share = 0.0;         ///< Mean share of pixels whose channels are all 0.
  double white_share = 0.0;         ///< Mean share of pixels with a channel at 255.
  double color_share = 0.0;         ///< Mean share of pixels whose channels differ.
  std::size_t backward_stamps = 0;  ///< Stamps that lie before the previous one.
  std::size_t stalled_stamps = 0;   ///< Stamps that equal the previous one.
  std::size_t gaps = 0;             ///< Steps longer than max_gap_s.
  double longest_step_s = 0.0;
  bool swapped = false;  ///< Left and right images are exchanged.
  std::vector<std::string> warnings;
};

/// Collects figures over a recording, at constant memory.
class SetupCheck {
 public:
  explicit SetupCheck(const SetupCheckParams& params = {});

  /// @param image_bgr  CV_8UC3.
  /// @param range      CV_32FC1, depths or disparities of the whole image, NaN or <= 0 for none;
  ///                   or empty where there is none yet.
  /// @throws std::invalid_argument  if the images have another type or do not fit.
  void add(double stamp_s, const cv::Mat& image_bgr, const cv::Mat& range);

  /// Tells whether left and right are exchanged; looking at one pair is enough.
  void addPair(const cv::Mat& left, const cv::Mat& right, StereoMatcher& matcher);

  SetupReport report() const;

 private:
  SetupCheckParams params_;
  SetupReport sums_;  // shares are sums until reported
  std::size_t ranges_ = 0;
  double last_stamp_s_ = 0.0;
  std::size_t first_backward_frame_ = 0;
};

/// Whether a rectified pair was taken with left and right exchanged: all disparities are then
/// negative, and the pair matches far better the other way round.
bool looksSwapped(const cv::Mat& left, const cv::Mat& right, StereoMatcher& matcher);

}  // namespace heel
