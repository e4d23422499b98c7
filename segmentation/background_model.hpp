// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The empty scene, per pixel of intensity and disparity, and what differs from it (section 2).
#pragma once

#include <opencv2/core/mat.hpp>

#include <cstdint>

namespace heel {

/// When a pixel differs from the empty scene.
///
/// Disparity is measured as inverse depth [1/m]: disparity divided by focal length and baseline, so
/// the same numbers hold for every stereo rig and for RGB-D cameras.
struct BackgroundParams {
  /// A pixel's depth is known if at least this share of the frames had it.
  double min_valid_share = 0.3;
  double min_disparity_step = 0.02;  ///< Smallest step towards the camera that counts [1/m].
};

/// What differs from the background in one frame. Reused from frame to frame.
struct Foreground {
  /// Bits of the mask. A pixel is foreground when its value is not 0.
  static constexpr std::uint8_t kInFront = 1;         ///< Disparity puts it before the background.
  static constexpr std::uint8_t kOtherIntensity = 2;  ///< Intensity differs.

  cv::Mat mask;       ///< CV_8UC1, the bits above.
  cv::Mat changed;    ///< CV_8UC1, not 0 where the intensity differs, be it only a shadow.
  cv::Mat gray;       ///< CV_8UC1, the frame's intensity.
  double gain = 1.0;  ///< How much brighter than the background the camera exposed this frame.
  int pixels = 0;     ///< How many are foreground.
  int compared = 0;   ///< On how many (of a sparse sample) the gain rests; 0 means it is a guess.
};

/// The empty scene. Immutable; BackgroundLearner makes it.
class BackgroundModel {
 public:
  BackgroundModel() = default;

  bool empty() const { return disparity_.empty(); }

  /// Share of the picture in which depth did not stay, over areas and not only along edges: large
  /// where somebody walked about while the scene should have been empty.
  double restlessShare() const { return restless_share_; }

  /// Marks what differs from the empty scene.
  ///
  /// A pixel is foreground if its disparity puts it before the background, or if its intensity
  /// differs where disparity cannot tell: there was none in the empty scene, or there is none now.
  /// So a shadow or a reflection (intensity changes, disparity does not) is left out, and so is the
  /// ghost of something that was carried away; a person in the wall's colour is kept. Intensities
  /// are compared after the camera's change of exposure, taken from pixels whose disparity is the
  /// background's, has been divided out.
  /// @param image_bgr  CV_8UC3, the size of the empty scene.
  /// @param depth_m    CV_32FC1, NaN or <= 0 where there is none.
  /// @throws std::invalid_argument  if sizes or types do not fit, or the model is empty.
  void extract(const cv::Mat& image_bgr, const cv::Mat& depth_m, Foreground& out) const;

 private:
  friend class BackgroundLearner;

  void estimateGain(const cv::Mat& depth_m, Foreground& out) const;

  cv::Mat disparity_;            // CV_32FC1, mean inverse depth; 0 where unknown
  cv::Mat disparity_tolerance_;  // CV_32FC1, infinite where depth is unknown
  cv::Mat intensity_;            // CV_32FC1, mean
  cv::Mat intensity_tolerance_;  // CV_32FC1
  double restless_share_ = 0.0;
};

/// Collects frames of the empty scene: mean, spread and, for disparity, how often it was valid.
class BackgroundLearner {
 public:
  /// @throws std::invalid_argument  if a parameter is negative or the share is not in (0, 1].
  explicit BackgroundLearner(const BackgroundParams& params = {});

  /// Adds one frame of the empty scene; arguments as for BackgroundModel::extract().
  /// @throws std::invalid_argument  if sizes or types do not fit.
  void add(const cv::Mat& image_bgr, const cv::Mat& depth_m);

  int frames() const { return frames_; }

  /// @throws std::invalid_argument  if no frame has been added.
  BackgroundModel model() const;

 private:
  BackgroundParams params_;
  int frames_ = 0;
  cv::Mat gray_;
  // Running means and sums of squared deviations (Welford), CV_32FC1; and the count of valid depth.
  cv::Mat valid_, disparity_, disparity_squares_, intensity_, intensity_squares_;
};

}  // namespace heel
