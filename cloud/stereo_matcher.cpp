// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/row_spans.hpp>
#include <heel/cloud/stereo_matcher.hpp>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

namespace heel {
namespace {

constexpr int kSpeckleRange = 1;  // Neighbours of one island differ by no more than this [px].

constexpr std::int16_t kNoMatch = -kDisparityScale;

void requireImages(bool holds, const char* rule) {
  if (!holds) throw std::invalid_argument(std::string("StereoMatcher: ") + rule);
}

}  // namespace

StereoMatcher::StereoMatcher(const StereoMatcherParams& params)
    : params_(checked(params)),
      dense_(cv::StereoSGBM::create(0, params.disparities, params.block_size, params.p1, params.p2,
                                    params.max_left_right_difference, params.prefilter_cap,
                                    params.uniqueness_percent, params.speckle_size, kSpeckleRange,
                                    cv::StereoSGBM::MODE_SGBM)),
      masked_(params_),
      margin_(2 * params.margin_px + 1, 2 * params.margin_px + 1, CV_8UC1, cv::Scalar(1)) {}

StereoMatcher::~StereoMatcher() = default;
StereoMatcher::StereoMatcher(StereoMatcher&&) noexcept = default;
StereoMatcher& StereoMatcher::operator=(StereoMatcher&&) noexcept = default;

/// Checks the images, makes them grey, and continues them at the left: then the first pixel has
/// the whole range of disparities.
void StereoMatcher::prepare(const cv::Mat& left, const cv::Mat& right) {
  requireImages(!left.empty() && !right.empty(), "an image is empty");
  requireImages(left.size() == right.size(), "left and right images differ in size");
  for (const auto& [image, wide] : {std::pair{&left, &left_}, std::pair{&right, &right_}}) {
    requireImages(image->type() == CV_8UC3 || image->type() == CV_8UC1,
                  "images must be 8-bit BGR or grey");
    if (image->channels() == 3) cv::cvtColor(*image, grey_, cv::COLOR_BGR2GRAY);
    cv::copyMakeBorder(image->channels() == 3 ? grey_ : *image, *wide, 0, 0, params_.disparities, 0,
                       cv::BORDER_REPLICATE);
  }
}

int StereoMatcher::match(const cv::Mat& left, const cv::Mat& right, cv::Mat& disparity) {
  prepare(left, right);
  dense_->compute(left_, right_, fixed_);
  supported_.create(left.size(), CV_8UC1);
  supported_.setTo(255);
  pixels_.find(supported_);
  return finish(pixels_, disparity);
}

MaskedMatch StereoMatcher::match(const cv::Mat& left, const cv::Mat& right, const cv::Mat& mask,
                                 cv::Mat& disparity) {
  prepare(left, right);
  requireImages(mask.type() == CV_8UC1 && mask.size() == left.size(),
                "the mask must be 8-bit and of the images' size");
  const SupportCount support = keepSupported(mask, params_.min_support, supported_, cells_);
  MaskedMatch result{support.wanted, support.kept, 0};

  cv::dilate(supported_, grown_, margin_);
  cv::copyMakeBorder(grown_, wanted_, 0, 0, params_.disparities, 0, cv::BORDER_CONSTANT);
  masked_.compute(left_, right_, wanted_, fixed_);

  // What cv::StereoSGBM does after matching.
  const cv::Rect bounds = masked_.bounds();
  if (!bounds.empty()) {
    const cv::Rect around(bounds.x - 1, bounds.y - 1, bounds.width + 2, bounds.height + 2);
    const cv::Rect inside = around & cv::Rect({}, fixed_.size());
    filtered_.create(fixed_.size(), fixed_.type());  // whole, for the next frame's bounds differ
    cv::Mat filtered = filtered_(inside);
    cv::medianBlur(fixed_(inside), filtered, 3);
    if (params_.speckle_size > 0) {
      cv::filterSpeckles(filtered, kNoMatch, params_.speckle_size, kSpeckleRange * kDisparityScale,
                         speckle_buffer_);
    }
    filtered.copyTo(fixed_(inside));
  }
  pixels_.find(supported_);
  result.matched = finish(pixels_, disparity);
  return result;
}

/// Turns fixed point into pixels where asked, NaN elsewhere and where the match lies outside.
int StereoMatcher::finish(const RowSpans& pixels, cv::Mat& disparity) const {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  disparity.create(supported_.size(), CV_32FC1);
  disparity.setTo(nan);
  int found = 0;
  for (int y = 0; y < disparity.rows; ++y) {
    const auto* fixed = fixed_.ptr<std::int16_t>(y) + params_.disparities;
    auto* out = disparity.ptr<float>(y);
    for (const Span& span : pixels.row(y)) {
      for (int x = span.begin; x < span.end; ++x) {
        const int d = fixed[x];
        const bool inside = d >= 0 && d <= x * kDisparityScale;
        out[x] = inside ? static_cast<float>(d) / kDisparityScale : nan;
        found += inside ? 1 : 0;
      }
    }
  }
  return found;
}

}  // namespace heel
