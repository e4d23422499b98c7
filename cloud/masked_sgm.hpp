// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Semi-global matching whose cost follows the number of pixels that are asked for.
#pragma once

#include <heel/cloud/row_spans.hpp>
#include <heel/cloud/sgm_kernels.hpp>
#include <heel/cloud/stereo_params.hpp>

#include <opencv2/core/mat.hpp>

#include <cstdint>
#include <vector>

namespace heel {

/// Disparities are in 1/16 px, as OpenCV's.
constexpr int kDisparityScale = 16;

/// The same algorithm as cv::StereoSGBM's five-path mode, computed on runs of pixels only: a path
/// starts where it enters the wanted region, as it would at the border of the image.
///
/// With everything wanted, its answer is exactly that of cv::StereoSGBM (a test says so). As there,
/// the first `disparities` columns have none: part of their range lies outside the right image.
/// Holds its workspace, so one object serves one thread. Not to be copied: its rows point into it.
class MaskedSgm {
 public:
  /// @throws std::invalid_argument  if a parameter is out of its range.
  explicit MaskedSgm(const StereoMatcherParams& params);
  MaskedSgm(const MaskedSgm&) = delete;
  MaskedSgm& operator=(const MaskedSgm&) = delete;
  MaskedSgm(MaskedSgm&&) = default;
  MaskedSgm& operator=(MaskedSgm&&) = default;

  /// @param left, right  CV_8UC1 of one size, rectified.
  /// @param wanted       CV_8UC1 of that size, not 0 where a disparity is wanted; must be 0 in the
  ///                     columns that have none.
  /// @param disparity    Out: CV_16SC1 in 1/16 px, negative where there is none.
  ///                     Neither median nor speckle filter is applied.
  /// @throws std::invalid_argument  if the images do not fit.
  void compute(const cv::Mat& left, const cv::Mat& right, const cv::Mat& wanted,
               cv::Mat& disparity);

  /// The least rectangle around the pixels that were wanted last.
  const cv::Rect& bounds() const { return spans_.bounds(); }

 private:
  struct FeatureBuffer {
    std::vector<std::uint8_t> memory;
    sgm::RowFeatures rows{};
    void resize(int width);
  };

  void prepare(int width);
  void sumColumnsOfRow(const cv::Mat& left, int y, const RowSpans::Row& spans);
  void aggregateRow(int y, const cv::Mat& wanted);
  void chooseRow(const RowSpans::Row& spans, std::int16_t* out);

  StereoMatcherParams params_;
  cv::Mat block_column_;
  int width_ = 0;
  cv::Mat mirrored_right_;  // so that disparities ascend in memory
  cv::Mat wide_;            // wanted, grown by the block's radius up and down
  RowSpans spans_, wide_spans_;
  FeatureBuffer left_features_, right_features_;
  std::vector<std::uint8_t> pixel_costs_;
  std::vector<std::vector<std::int16_t>> column_sums_;  // a ring of rows, one block high
  std::vector<std::int16_t> costs_, totals_;
  std::vector<std::int16_t> paths_above_, paths_here_, minima_above_, minima_here_;
  std::vector<sgm::Winner> winners_;
  std::vector<std::int16_t> right_total_, right_disparity_;  // of each right pixel's best match
};

}  // namespace heel
