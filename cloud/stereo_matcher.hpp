// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Disparities of a rectified stereo pair: of the whole image, or only where a mask says.
#pragma once

#include <heel/cloud/masked_sgm.hpp>
#include <heel/cloud/stereo_params.hpp>

#include <opencv2/core/mat.hpp>

#include <vector>

namespace cv {
class StereoSGBM;
}

namespace heel {

/// What became of the pixels that a mask asked for: wanted >= supported >= matched.
struct MaskedMatch {
  int wanted = 0;     ///< Non-zero pixels of the mask.
  int supported = 0;  ///< Of them, those that don't stand in specks (min_support).
  int matched = 0;    ///< Of them, those with a disparity.
};

/// Matches rectified pairs by semi-global matching, dense with cv::StereoSGBM.
///
/// Disparities are u_left - u_right in pixels, CV_32FC1, NaN where there is none. Pixels near the
/// left border are matched as well: both images are continued there with their border's colours,
/// and a match that points beyond the right image is taken back. Holds its workspace, so one
/// object serves one thread.
class StereoMatcher {
 public:
  /// @throws std::invalid_argument  if a parameter is out of its range.
  explicit StereoMatcher(const StereoMatcherParams& params = {});
  ~StereoMatcher();
  StereoMatcher(StereoMatcher&& other) noexcept;
  StereoMatcher& operator=(StereoMatcher&& other) noexcept;

  const StereoMatcherParams& params() const { return params_; }

  /// Matches every pixel.
  ///
  /// @param left, right  CV_8UC3 (BGR) or CV_8UC1, of one size.
  /// @param disparity    Out; its memory is reused.
  /// @return how many pixels have a disparity.
  /// @throws std::invalid_argument  if the images are empty or do not fit.
  int match(const cv::Mat& left, const cv::Mat& right, cv::Mat& disparity);

  /// Matches the pixels where `mask` (CV_8UC1) is not 0; all others are NaN. The same algorithm
  /// runs on the masked pixels and a margin around them, so the time follows their number.
  /// Pixels in specks too small to be matched reliably are left out (min_support).
  MaskedMatch match(const cv::Mat& left, const cv::Mat& right, const cv::Mat& mask,
                    cv::Mat& disparity);

 private:
  void prepare(const cv::Mat& left, const cv::Mat& right);
  int finish(const RowSpans& pixels, cv::Mat& disparity) const;

  StereoMatcherParams params_;
  cv::Ptr<cv::StereoSGBM> dense_;
  MaskedSgm masked_;
  cv::Mat margin_;
  cv::Mat grey_, left_, right_;  // left_ and right_ are continued at the left by `disparities`
  cv::Mat supported_, grown_, wanted_, fixed_, filtered_, speckle_buffer_;
  std::vector<int> cells_;
  RowSpans pixels_;
};

}  // namespace heel
