// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/segmentation/background_model.hpp>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>

namespace heel {
namespace {

// A step also counts only from this many times the pixel's own spread on.
constexpr double kDisparitySpreads = 4.0;
constexpr double kIntensitySpreads = 4.0;
constexpr double kMinIntensityStep = 20.0;  // Smallest change of intensity that counts, of 255.

constexpr float kUnknown = std::numeric_limits<float>::infinity();
constexpr int kGainStride = 4;       // one pixel in 16 is plenty for one number
constexpr int kMinGainPixels = 100;  // fewer say nothing about the exposure
constexpr float kDarkest = 20.0F;    // below, noise; above the brightest, the sensor saturates
constexpr float kBrightest = 245.0F;
constexpr int kEdge = 80;  // Edges whose depth flickers are no wider than this part of the picture.

void checkFrame(const cv::Mat& image_bgr, const cv::Mat& depth_m, cv::Size expected) {
  if (image_bgr.type() != CV_8UC3 || image_bgr.empty()) {
    throw std::invalid_argument("background: the image must be BGR, 8 bit");
  }
  if (depth_m.type() != CV_32FC1 || depth_m.size() != image_bgr.size()) {
    throw std::invalid_argument("background: depth must be 32-bit float, as large as the image");
  }
  if (expected.area() > 0 && image_bgr.size() != expected) {
    throw std::invalid_argument("background: the image's size differs from the empty scene's");
  }
}

// Inverse depth, 0 where there is none (NaN compares false).
inline float disparityOf(float depth_m) { return depth_m > 0.0F ? 1.0F / depth_m : 0.0F; }

// One row of extract(); apart, and with restrict, so that the compiler vectorises it.
void extractRow(int width, float gain, const float* __restrict depth_m,
                const std::uint8_t* __restrict gray, const float* __restrict disparity,
                const float* __restrict disparity_tolerance, const float* __restrict intensity,
                const float* __restrict intensity_tolerance, std::uint8_t* __restrict changed,
                std::uint8_t* __restrict mask) {
  for (int u = 0; u < width; ++u) {
    const float now = disparityOf(depth_m[u]);
    const auto front = static_cast<int>(now - disparity[u] > disparity_tolerance[u]);
    // Disparity decides alone where both the background's and this frame's are known.
    const int decided = static_cast<int>(now > 0.0F) & static_cast<int>(disparity[u] > 0.0F);
    const float change = static_cast<float>(gray[u]) - gain * intensity[u];
    const auto differs = static_cast<int>(std::abs(change) > intensity_tolerance[u]);
    changed[u] = static_cast<std::uint8_t>(differs);
    const int shown = front | (differs & (1 - decided));
    mask[u] = static_cast<std::uint8_t>(shown * (front + 2 * differs));
  }
}

}  // namespace

BackgroundLearner::BackgroundLearner(const BackgroundParams& params) : params_(params) {
  if (!(params.min_valid_share > 0.0 && params.min_valid_share <= 1.0)) {
    throw std::invalid_argument("background: min_valid_share must be in (0, 1]");
  }
  if (!(params.min_disparity_step >= 0.0)) {
    throw std::invalid_argument("background: min_disparity_step must not be negative");
  }
}

void BackgroundLearner::add(const cv::Mat& image_bgr, const cv::Mat& depth_m) {
  checkFrame(image_bgr, depth_m, intensity_.size());
  if (frames_ == 0) {
    for (cv::Mat* m :
         {&valid_, &disparity_, &disparity_squares_, &intensity_, &intensity_squares_}) {
      *m = cv::Mat::zeros(image_bgr.size(), CV_32FC1);
    }
  }
  ++frames_;
  cv::cvtColor(image_bgr, gray_, cv::COLOR_BGR2GRAY);
  const float share = 1.0F / static_cast<float>(frames_);
  for (int v = 0; v < gray_.rows; ++v) {
    const auto* gray = gray_.ptr<std::uint8_t>(v);
    const auto* depth = depth_m.ptr<float>(v);
    auto* valid = valid_.ptr<float>(v);
    auto* mean = disparity_.ptr<float>(v);
    auto* squares = disparity_squares_.ptr<float>(v);
    auto* gray_mean = intensity_.ptr<float>(v);
    auto* gray_squares = intensity_squares_.ptr<float>(v);
    for (int u = 0; u < gray_.cols; ++u) {
      const float step = static_cast<float>(gray[u]) - gray_mean[u];
      gray_mean[u] += step * share;
      gray_squares[u] += step * (static_cast<float>(gray[u]) - gray_mean[u]);
      const float disparity = disparityOf(depth[u]);
      if (disparity > 0.0F) {
        valid[u] += 1.0F;
        const float move = disparity - mean[u];
        mean[u] += move / valid[u];
        squares[u] += move * (disparity - mean[u]);
      }
    }
  }
}

BackgroundModel BackgroundLearner::model() const {
  if (frames_ == 0) throw std::invalid_argument("background: no frame of the empty scene");
  BackgroundModel model;
  model.disparity_ = disparity_.clone();
  model.intensity_ = intensity_.clone();
  model.disparity_tolerance_.create(disparity_.size(), CV_32FC1);
  model.intensity_tolerance_.create(disparity_.size(), CV_32FC1);
  const auto frames = static_cast<float>(frames_);
  const float min_valid = static_cast<float>(params_.min_valid_share) * frames;
  const auto min_step = static_cast<float>(params_.min_disparity_step);
  const auto spreads = static_cast<float>(kDisparitySpreads);
  const auto min_gray_step = static_cast<float>(kMinIntensityStep);
  const auto gray_spreads = static_cast<float>(kIntensitySpreads);
  cv::Mat restless = cv::Mat::zeros(valid_.size(), CV_8UC1);
  for (int v = 0; v < valid_.rows; ++v) {
    for (int u = 0; u < valid_.cols; ++u) {
      const float valid = valid_.at<float>(v, u);
      const bool known = valid > 0.0F && valid >= min_valid;
      if (!known) model.disparity_.at<float>(v, u) = 0.0F;
      const float spread = known ? std::sqrt(disparity_squares_.at<float>(v, u) / valid) : 0.0F;
      model.disparity_tolerance_.at<float>(v, u) =
          known ? std::max(min_step, spreads * spread) : kUnknown;
      restless.at<std::uint8_t>(v, u) = spread > min_step ? 1 : 0;
      model.intensity_tolerance_.at<float>(v, u) = std::max(
          min_gray_step, gray_spreads * std::sqrt(intensity_squares_.at<float>(v, u) / frames));
    }
  }
  const int edge = std::max(1, restless.cols / kEdge);
  cv::erode(restless, restless, cv::Mat::ones(edge, edge, CV_8UC1));
  model.restless_share_ = cv::countNonZero(restless) / static_cast<double>(restless.total());
  return model;
}

void BackgroundModel::estimateGain(const cv::Mat& depth_m, Foreground& out) const {
  double now_sum = 0.0;
  double then_sum = 0.0;
  int count = 0;
  for (int v = 0; v < depth_m.rows; v += kGainStride) {
    const auto* depth = depth_m.ptr<float>(v);
    const auto* gray = out.gray.ptr<std::uint8_t>(v);
    const auto* disparity = disparity_.ptr<float>(v);
    const auto* tolerance = disparity_tolerance_.ptr<float>(v);
    const auto* intensity = intensity_.ptr<float>(v);
    for (int u = 0; u < depth_m.cols; u += kGainStride) {
      const auto now = static_cast<float>(gray[u]);
      const float disparity_now = disparityOf(depth[u]);
      const bool background = disparity_now > 0.0F && disparity[u] > 0.0F &&
                              std::abs(disparity_now - disparity[u]) <= tolerance[u];
      if (background && now < kBrightest && intensity[u] < kBrightest && intensity[u] > kDarkest) {
        now_sum += static_cast<double>(now);
        then_sum += static_cast<double>(intensity[u]);
        ++count;
      }
    }
  }
  out.compared = count;
  out.gain = count >= kMinGainPixels && now_sum > 0.0 ? now_sum / then_sum : 1.0;
}

void BackgroundModel::extract(const cv::Mat& image_bgr, const cv::Mat& depth_m,
                              Foreground& out) const {
  if (empty()) throw std::invalid_argument("background: the model is empty");
  checkFrame(image_bgr, depth_m, disparity_.size());
  cv::cvtColor(image_bgr, out.gray, cv::COLOR_BGR2GRAY);
  out.mask.create(image_bgr.size(), CV_8UC1);
  out.changed.create(image_bgr.size(), CV_8UC1);
  estimateGain(depth_m, out);
  for (int v = 0; v < depth_m.rows; ++v) {
    extractRow(depth_m.cols, static_cast<float>(out.gain), depth_m.ptr<float>(v),
               out.gray.ptr<std::uint8_t>(v), disparity_.ptr<float>(v),
               disparity_tolerance_.ptr<float>(v), intensity_.ptr<float>(v),
               intensity_tolerance_.ptr<float>(v), out.changed.ptr<std::uint8_t>(v),
               out.mask.ptr<std::uint8_t>(v));
  }
  out.pixels = cv::countNonZero(out.mask);
}

}  // namespace heel
