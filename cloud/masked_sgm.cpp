// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/masked_sgm.hpp>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <stdexcept>

namespace heel {
namespace {

constexpr int kMaxBlock = 5;
constexpr std::int16_t kNone = -kDisparityScale;

/// Disparity in 1/16 px of the parabola through the winner and its neighbours.
int refine(const sgm::Winner& w, int disparities) {
  const int d = w.index * kDisparityScale;
  if (w.index == 0 || w.index + 1 == disparities) return d;
  const int bend = std::max(w.before + w.after - 2 * w.total, 1);
  return d + ((w.before - w.after) * kDisparityScale + bend) / (bend * 2);
}

}  // namespace

MaskedSgm::MaskedSgm(const StereoMatcherParams& params)
    : params_(checked(params)), block_column_(params.block_size, 1, CV_8UC1, cv::Scalar(1)) {}

void MaskedSgm::FeatureBuffer::resize(int width) {
  const auto n = static_cast<std::size_t>(width);
  memory.resize(6 * n);
  std::uint8_t* at = memory.data();
  for (sgm::Features* f : {&rows.gradient, &rows.brightness}) {
    for (std::uint8_t** array : {&f->value, &f->low, &f->high}) {
      *array = at;
      at += n;
    }
  }
}

void MaskedSgm::prepare(int width) {
  if (width == width_) return;
  width_ = width;
  const auto n = static_cast<std::size_t>(width);
  const auto D = static_cast<std::size_t>(params_.disparities);
  left_features_.resize(width);
  right_features_.resize(width);
  pixel_costs_.resize(n * D);
  column_sums_.assign(static_cast<std::size_t>(params_.block_size),
                      std::vector<std::int16_t>(n * D));
  costs_.resize(n * D);
  totals_.resize(n * D);
  for (auto* paths : {&paths_above_, &paths_here_}) {
    paths->assign(n * sgm::kPathsFromAbove * (D + sgm::kPadding), sgm::kInfinite);
  }
  for (auto* minima : {&minima_above_, &minima_here_}) {
    minima->assign(n * sgm::kPathsFromAbove, 0);
  }
  winners_.resize(n);
  right_total_.resize(n);
  right_disparity_.resize(n);
}

void MaskedSgm::compute(const cv::Mat& left, const cv::Mat& right, const cv::Mat& wanted,
                        cv::Mat& disparity) {
  if (left.type() != CV_8UC1 || right.type() != CV_8UC1 || wanted.type() != CV_8UC1 ||
      left.size() != right.size() || left.size() != wanted.size()) {
    throw std::invalid_argument("MaskedSgm: images and mask must be 8-bit and of one size");
  }
  prepare(left.cols);
  disparity.create(left.size(), CV_16SC1);
  disparity.setTo(kNone);
  spans_.find(wanted);
  if (bounds().empty()) return;
  if (bounds().x < params_.disparities) {
    throw std::invalid_argument("MaskedSgm: the first columns have no disparity to be wanted");
  }
  cv::dilate(wanted, wide_, block_column_);
  wide_spans_.find(wide_);
  cv::flip(right, mirrored_right_, 1);

  const int radius = params_.block_size / 2;
  int next_sum = wide_spans_.bounds().y;  // the next row whose columns are to be summed
  for (int y = bounds().y; y < bounds().br().y; ++y) {
    for (; next_sum <= std::min(y + radius, left.rows - 1); ++next_sum) {
      sumColumnsOfRow(left, next_sum, wide_spans_.row(next_sum));
    }
    aggregateRow(y, wanted);
    chooseRow(spans_.row(y), disparity.ptr<std::int16_t>(y));
    paths_above_.swap(paths_here_);
    minima_above_.swap(minima_here_);
  }
}

/// Block costs, paths and winners of a row.
void MaskedSgm::aggregateRow(int y, const cv::Mat& wanted) {
  const int radius = params_.block_size / 2;
  std::array<const std::int16_t*, kMaxBlock> block{};
  for (int k = -radius; k <= radius; ++k) {
    const int row = std::clamp(y + k, 0, wanted.rows - 1) % params_.block_size;
    block[static_cast<std::size_t>(k + radius)] =
        column_sums_[static_cast<std::size_t>(row)].data();
  }
  sgm::PathRow row{};
  row.disparities = params_.disparities;
  row.p1 = static_cast<std::int16_t>(params_.p1);
  row.p2 = static_cast<std::int16_t>(params_.p2);
  row.above = y > 0 ? wanted.ptr<std::uint8_t>(y - 1) : nullptr;
  row.width = wanted.cols;
  row.costs = costs_.data();
  row.totals = totals_.data();
  row.from_above = paths_above_.data();
  row.to_below = paths_here_.data();
  row.minima_above = minima_above_.data();
  row.minima_below = minima_here_.data();
  for (const Span& span : spans_.row(y)) {
    sgm::sumRows(block.data(), params_.block_size, span.begin, span.end, params_.disparities,
                 costs_.data());
    sgm::forwardPass(row, span.begin, span.end);
    sgm::backwardPass(row, span.begin, span.end, params_.uniqueness_percent, winners_.data());
  }
}

/// The costs of a row's pixels, summed over the columns of a block.
void MaskedSgm::sumColumnsOfRow(const cv::Mat& left, int y, const RowSpans::Row& spans) {
  if (spans.empty()) return;
  const int radius = params_.block_size / 2, width = left.cols;
  const int above = std::max(y - 1, 0), below = std::min(y + 1, left.rows - 1);
  const int begin = std::max(spans.first->begin - radius, params_.disparities);
  const int end = std::min((spans.last - 1)->end + radius, width);
  sgm::rowFeatures(left.ptr<std::uint8_t>(above), left.ptr<std::uint8_t>(y),
                   left.ptr<std::uint8_t>(below), width, begin, end, params_.prefilter_cap, 1,
                   left_features_.rows);
  // Left pixel x at disparity d meets right pixel x - d, which is mirrored column width - 1 - x +
  // d.
  const int right_start = width - 1;
  sgm::rowFeatures(mirrored_right_.ptr<std::uint8_t>(above), mirrored_right_.ptr<std::uint8_t>(y),
                   mirrored_right_.ptr<std::uint8_t>(below), width, right_start - (end - 1),
                   right_start - begin + params_.disparities, params_.prefilter_cap, -1,
                   right_features_.rows);
  auto& sums = column_sums_[static_cast<std::size_t>(y % params_.block_size)];
  int done = begin;  // runs may be nearer to each other than a block
  for (const Span& span : spans) {
    const int from = std::max(span.begin - radius, done), to = std::min(span.end + radius, width);
    sgm::pixelCosts(left_features_.rows, right_features_.rows, right_start, from, to,
                    params_.disparities, pixel_costs_.data());
    done = std::max(done, to);
    sgm::sumColumns(pixel_costs_.data(), span.begin, span.end, params_.disparities, width - 1,
                    radius, params_.disparities, sums.data());
  }
}

/// Takes each winner that is unique and that the right image's view confirms.
void MaskedSgm::chooseRow(const RowSpans::Row& spans, std::int16_t* out) {
  if (spans.empty()) return;
  std::fill(right_total_.begin(), right_total_.end(), INT16_MAX);
  std::fill(right_disparity_.begin(), right_disparity_.end(), std::int16_t{-1});
  for (const Span* span = spans.last; span-- != spans.first;) {
    for (int x = span->end - 1; x >= span->begin; --x) {
      const sgm::Winner& w = winners_[static_cast<std::size_t>(x)];
      if (w.index < 0) continue;
      const auto seen_at = static_cast<std::size_t>(x - w.index);
      if (right_total_[seen_at] > w.total) {
        right_total_[seen_at] = w.total;
        right_disparity_[seen_at] = w.index;
      }
      out[x] = static_cast<std::int16_t>(refine(w, params_.disparities));
    }
  }
  const auto denied = [&](int x, int d) {
    const int seen = right_disparity_[static_cast<std::size_t>(x - d)];
    return seen >= 0 && std::abs(seen - d) > params_.max_left_right_difference;
  };
  for (const Span& span : spans) {
    for (int x = span.begin; x < span.end; ++x) {
      const int d = out[x];
      if (d < 0) continue;
      if (denied(x, d / kDisparityScale) &&
          denied(x, (d + kDisparityScale - 1) / kDisparityScale)) {
        out[x] = kNone;
      }
    }
  }
}

}  // namespace heel
