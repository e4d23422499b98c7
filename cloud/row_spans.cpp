// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/row_spans.hpp>

#include <algorithm>
#include <cstddef>
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

namespace {

constexpr int kCell = 8;

/// Counts of non-zero pixels, cell by cell, in a frame of empty cells.
class Cells {
 public:
  Cells(const cv::Mat& mask, std::vector<int>& memory)
      : columns_((mask.cols + kCell - 1) / kCell + 2), counts_(memory) {
    const int rows = (mask.rows + kCell - 1) / kCell + 2;
    counts_.assign(static_cast<std::size_t>(rows * columns_), 0);
    for (int y = 0; y < mask.rows; ++y) {
      const auto* row = mask.ptr<std::uint8_t>(y);
      for (int x = 0; x < mask.cols; x += kCell) {
        const int end = std::min(x + kCell, mask.cols);
        int set = 0;
        for (int i = x; i < end; ++i) set += row[i] != 0 ? 1 : 0;
        at(y / kCell, x / kCell) += set;
      }
    }
  }

  /// Cells of the image count from 0; -1 and one past the last are the frame.
  int& at(int row, int column) {
    return counts_[static_cast<std::size_t>((row + 1) * columns_ + column + 1)];
  }

  int around(int row, int column) {
    int sum = 0;
    for (int r = row - 1; r <= row + 1; ++r) {
      for (int c = column - 1; c <= column + 1; ++c) sum += at(r, c);
    }
    return sum;
  }

 private:
  int columns_;
  std::vector<int>& counts_;
};

}  // namespace

SupportCount keepSupported(const cv::Mat& mask, double min_share, cv::Mat& kept,
                           std::vector<int>& cells) {
  kept.create(mask.size(), CV_8UC1);
  kept.setTo(0);
  SupportCount result;
  Cells counts(mask, cells);
  const cv::Rect image({}, mask.size());
  for (int top = 0; top < mask.rows; top += kCell) {
    for (int left = 0; left < mask.cols; left += kCell) {
      const int own = counts.at(top / kCell, left / kCell);
      if (own == 0) continue;
      result.wanted += own;
      const cv::Rect window = cv::Rect(left - kCell, top - kCell, 3 * kCell, 3 * kCell) & image;
      if (counts.around(top / kCell, left / kCell) < min_share * window.area()) continue;
      result.kept += own;
      const cv::Rect cell = cv::Rect(left, top, kCell, kCell) & image;
      for (int y = cell.y; y < cell.br().y; ++y) {
        const auto* from = mask.ptr<std::uint8_t>(y);
        auto* to = kept.ptr<std::uint8_t>(y);
        for (int x = cell.x; x < cell.br().x; ++x) to[x] = from[x] != 0 ? 255 : 0;
      }
    }
  }
  return result;
}

}  // namespace heel
