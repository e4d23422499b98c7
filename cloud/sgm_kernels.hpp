// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The inner loops of semi-global matching (Hirschmueller, PAMI 2008), in OpenCV's variant: the
/// cost of Birchfield and Tomasi on a horizontal gradient and on the brightness, summed over a
/// block; five paths in one pass over the image.
///
/// Every loop runs over the disparities of one pixel, in 8 or 16 bits, so that compilers turn it
/// into vector instructions. "Pixel-major" arrays hold the disparities of pixel x from x * stride.
#pragma once

#include <array>
#include <cstdint>

namespace heel::sgm {

/// A padded vector of path costs has this many elements beyond its disparities: room for the
/// "infinite" neighbours of the first and the last disparity, on 16-byte boundaries.
constexpr int kPadding = 16;
/// Where disparity 0 stands in a padded vector.
constexpr int kLead = 8;
/// The cost of what cannot be.
constexpr std::int16_t kInfinite = 0x7000;
/// The paths that come from the row above (from its left, its middle, its right).
constexpr int kPathsFromAbove = 3;

/// Two features of a row of pixels, each with its range when interpolated half a pixel either way.
struct Features {
  std::uint8_t* value;
  std::uint8_t* low;
  std::uint8_t* high;
};
/// What two pixels are compared by.
struct RowFeatures {
  Features gradient;    ///< Sobel in x, cut to +-cap, plus cap.
  Features brightness;  ///< As it is.
};

/// Computes the features of columns [begin, end) of an image row of `width` pixels; `above` and
/// `below` are its neighbours. `sign` is -1 for a mirrored row, so that its gradient is not.
void rowFeatures(const std::uint8_t* above, const std::uint8_t* row, const std::uint8_t* below,
                 int width, int begin, int end, int cap, int sign, const RowFeatures& out);

/// Birchfield-Tomasi costs of the left pixels [begin, end), pixel-major with stride `disparities`.
/// Pixel x at disparity index d is compared with element right_start - x + d of `right`.
void pixelCosts(const RowFeatures& left, const RowFeatures& right, int right_start, int begin,
                int end, int disparities, std::uint8_t* costs);

/// Sums `costs` over 2 radius + 1 columns for each pixel of [begin, end); what lies beyond the
/// first or the last column counts as that column.
void sumColumns(const std::uint8_t* costs, int begin, int end, int first_column, int last_column,
                int radius, int disparities, std::int16_t* sums);

/// What the passes along a row share.
struct PathRow {
  int disparities;
  std::int16_t p1, p2;             ///< Penalties of a disparity change by 1, and by more.
  const std::uint8_t* above;       ///< Not 0 where the row above was computed; null: there is none.
  int width;                       ///< Pixels in a row.
  std::int16_t* costs;             ///< Block costs, pixel-major, stride `disparities`.
  std::int16_t* totals;            ///< Sums over the paths, pixel-major, stride `disparities`.
  const std::int16_t* from_above;  ///< Padded path costs of the row above, [x][path].
  std::int16_t* to_below;          ///< The same of this row, written.
  const std::int16_t* minima_above;  ///< [x][path], least of each vector of `from_above`.
  std::int16_t* minima_below;
};

/// Sums the block costs of [begin, end) over `rows` rows of column sums.
void sumRows(const std::int16_t* const* rows, int row_count, int begin, int end, int disparities,
             std::int16_t* costs);

/// The path from the left and the three from above, for the pixels [begin, end), left to right.
void forwardPass(const PathRow& row, int begin, int end);

/// The least total of a pixel, and whether no distant disparity comes near it.
struct Winner {
  std::int16_t total;
  std::int16_t index;   ///< -1 if it is not unique.
  std::int16_t before;  ///< Totals of the neighbours, for the parabola; kInfinite at the ends.
  std::int16_t after;
};

/// The path from the right, for the pixels [begin, end), right to left; then each one's winner in
/// winners[x]. A winner is unique if no disparity more than 1 away has a total that is less than
/// 100 / (100 - uniqueness_percent) of its own.
void backwardPass(const PathRow& row, int begin, int end, int uniqueness_percent, Winner* winners);

}  // namespace heel::sgm
