// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The runs of wanted pixels in a mask, row by row.
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

}  // namespace heel
