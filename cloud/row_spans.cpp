// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/row_spans.hpp>

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace heel {
namespace {

/// The first column from `x` on that is not 0, or `width`. Empty stretches go by eight at a time.
int skipZeros(const std::uint8_t* row, int x, int width) {
  for (; x + 8 <= width; x += 8) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, row + x, sizeof eight);
    if (eight != 0) break;
  }
  while (x < width && row[x] == 0) ++x;
  return x;
}

}  // namespace

void RowSpans::find(const cv::Mat& mask) {
  spans_.clear();
  starts_.clear();
  int top = mask.rows, bottom = 0, left = mask.cols, right = 0;
  for (int y = 0; y < mask.rows; ++y) {
    starts_.push_back(spans_.size());
    const auto* row = mask.ptr<std::uint8_t>(y);
    int x = skipZeros(row, 0, mask.cols);
    if (x == mask.cols) continue;
    top = std::min(top, y);
    bottom = y + 1;
    left = std::min(left, x);
    while (x < mask.cols) {
      const auto* end = static_cast<const std::uint8_t*>(
          std::memchr(row + x, 0, static_cast<std::size_t>(mask.cols - x)));
      const int stop = end == nullptr ? mask.cols : static_cast<int>(end - row);
      spans_.push_back({x, stop});
      x = skipZeros(row, stop, mask.cols);
    }
    right = std::max(right, spans_.back().end);
  }
  starts_.push_back(spans_.size());
  bounds_ = spans_.empty() ? cv::Rect() : cv::Rect(left, top, right - left, bottom - top);
}

}  // namespace heel
