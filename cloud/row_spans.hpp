// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The runs of wanted pixels in a mask, row by row, and which of its pixels stand in company.
#pragma once

#include <opencv2/core/mat.hpp>

#include <cstddef>
#include <vector>

namespace heel {

/// Columns [begin, end) of a row.
struct Span {
  int begin = 0;
  int end = 0;
};

/// The runs of non-zero pixels of an 8-bit mask. Its memory is reused from mask to mask.
class RowSpans {
 public:
  /// A range for loops: `for (const Span& span : spans.row(y))`.
  struct Row {
    const Span* first;
    const Span* last;
    const Span* begin() const { return first; }
    const Span* end() const { return last; }
    bool empty() const { return first == last; }
  };

  /// @param mask  CV_8UC1.
  void find(const cv::Mat& mask);

  Row row(int y) const {
    const auto i = static_cast<std::size_t>(y);
    return {spans_.data() + starts_[i], spans_.data() + starts_[i + 1]};
  }

  /// The least rectangle around all runs; empty if there are none.
  const cv::Rect& bounds() const { return bounds_; }

 private:
  std::vector<Span> spans_;
  std::vector<std::size_t> starts_;  // of each row in spans_, and one past the last
  cv::Rect bounds_;
};

/// What was left of a mask.
struct SupportCount {
  int wanted = 0;  ///< Non-zero pixels of the mask.
  int kept = 0;    ///< Of them, those with support.
};

/// Keeps the pixels of `mask` around which enough others are set, and drops lone specks: of the
/// three by three cells of 8x8 px around a pixel, a share of at least `min_share` must be set.
///
/// @param mask  CV_8UC1, not 0 where set.
/// @param kept   Out: CV_8UC1, 255 where kept; its memory is reused.
/// @param cells  Scratch; its memory is reused.
SupportCount keepSupported(const cv::Mat& mask, double min_share, cv::Mat& kept,
                           std::vector<int>& cells);

}  // namespace heel
