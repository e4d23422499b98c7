// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/setup_check.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace heel {
namespace {

constexpr double kMinFoundShare = 0.3;    // Warn if fewer of the pixels have a depth or disparity.
constexpr double kMaxClippedShare = 0.2;  // Warn if more of them are quite black, or quite white.

constexpr double kMoreConsistent = 1.5;  // swapped pairs match by this much better the other way
constexpr double kLeastConsistentShare = 0.1;  // of the pixels; fewer prove nothing

std::string percent(double share) {
  return std::to_string(static_cast<int>(std::lround(100.0 * share))) + " %";
}

}  // namespace

SetupCheck::SetupCheck(const SetupCheckParams& params) : params_(params) {
  if (!(params.max_gap_s > 0.0)) {
    throw std::invalid_argument("SetupCheck: max_gap_s must be positive");
  }
}

void SetupCheck::add(double stamp_s, const cv::Mat& image_bgr, const cv::Mat& range) {
  if (image_bgr.empty() || image_bgr.type() != CV_8UC3) {
    throw std::invalid_argument("SetupCheck: the image must be 8-bit BGR");
  }
  if (!range.empty() && (range.type() != CV_32FC1 || range.size() != image_bgr.size())) {
    throw std::invalid_argument("SetupCheck: the depths do not fit the image");
  }
  if (sums_.frames > 0) {
    const double step_s = stamp_s - last_stamp_s_;
    if (step_s < 0.0 && sums_.backward_stamps++ == 0) first_backward_frame_ = sums_.frames + 1;
    if (step_s == 0.0) ++sums_.stalled_stamps;
    if (step_s > params_.max_gap_s) ++sums_.gaps;
    sums_.longest_step_s = std::max(sums_.longest_step_s, step_s);
  }
  last_stamp_s_ = stamp_s;
  ++sums_.frames;

  int black = 0, white = 0, colored = 0, found = 0;
  for (int v = 0; v < image_bgr.rows; ++v) {
    const auto* bgr = image_bgr.ptr<cv::Vec3b>(v);
    for (int u = 0; u < image_bgr.cols; ++u) {
      const std::uint8_t brightest = std::max({bgr[u][0], bgr[u][1], bgr[u][2]});
      black += brightest == 0 ? 1 : 0;
      colored += bgr[u][0] != bgr[u][1] || bgr[u][1] != bgr[u][2] ? 1 : 0;
      white += brightest == 255 ? 1 : 0;
    }
    if (range.empty()) continue;
    const auto* value = range.ptr<float>(v);
    for (int u = 0; u < range.cols; ++u) found += value[u] > 0.0F ? 1 : 0;
  }
  const auto pixels = static_cast<double>(image_bgr.total());
  sums_.black_share += black / pixels;
  sums_.white_share += white / pixels;
  sums_.color_share += colored / pixels;
  if (!range.empty()) {
    sums_.found_share += found / pixels;
    ++ranges_;
  }
}

void SetupCheck::addPair(const cv::Mat& left, const cv::Mat& right, StereoMatcher& matcher) {
  sums_.swapped = sums_.swapped || looksSwapped(left, right, matcher);
}

SetupReport SetupCheck::report() const {
  SetupReport r = sums_;
  const auto mean = [](double sum, std::size_t n) {
    return n > 0 ? sum / static_cast<double>(n) : 0.0;
  };
  r.found_share = mean(sums_.found_share, ranges_);
  r.black_share = mean(sums_.black_share, r.frames);
  r.white_share = mean(sums_.white_share, r.frames);
  r.color_share = mean(sums_.color_share, r.frames);

  const std::string of_frames = " of " + std::to_string(r.frames) + " frames";
  const auto warn = [&](const std::string& sentence) { r.warnings.push_back(sentence); };
  if (r.frames == 0) warn("There is no frame.");
  if (r.swapped) {
    warn("Left and right images are exchanged (all disparities are negative): swap the cameras.");
  }
  if (ranges_ > 0 && r.found_share < kMinFoundShare) {
    warn("Only " + percent(r.found_share) +
         " of the pixels have a depth: check calibration, focus and light.");
  }
  if (r.backward_stamps > 0) {
    warn("The time stamps of " + std::to_string(r.backward_stamps) + of_frames +
         " run backwards, first at frame " + std::to_string(first_backward_frame_) + ".");
  }
  if (r.stalled_stamps > 0) {
    warn("The time stamps of " + std::to_string(r.stalled_stamps) + of_frames +
         " equal the one before.");
  }
  if (r.gaps > 0) {
    warn("Between frames, " + std::to_string(r.gaps) + " times, more than " +
         std::to_string(static_cast<int>(std::lround(1e3 * params_.max_gap_s))) +
         " ms went by, at most " +
         std::to_string(static_cast<int>(std::lround(1e3 * r.longest_step_s))) + " ms.");
  }
  if (r.frames > 0 && r.color_share == 0.0) {
    warn(
        "The pictures are grey: whom to follow is told by brightness alone, and who is as bright "
        "as they are, or a wall that is, is taken for them.");
  }
  if (r.black_share > kMaxClippedShare) {
    warn(percent(r.black_share) + " of the pixels are quite black: expose longer or add light.");
  }
  if (r.white_share > kMaxClippedShare) {
    warn(percent(r.white_share) + " of the pixels are clipped at white: expose shorter.");
  }
  return r;
}

bool looksSwapped(const cv::Mat& left, const cv::Mat& right, StereoMatcher& matcher) {
  cv::Mat disparity;
  const int as_given = matcher.match(left, right, disparity);
  // NOLINTNEXTLINE(readability-suspicious-call-argument): that is the question.
  const int exchanged = matcher.match(right, left, disparity);
  return exchanged > kLeastConsistentShare * static_cast<double>(left.total()) &&
         exchanged > kMoreConsistent * as_given;
}

}  // namespace heel
