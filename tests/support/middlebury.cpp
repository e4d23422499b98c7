// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/middlebury.hpp"

#include <heel/cloud/stereo_calibration.hpp>

#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace heel::test {
namespace {

/// A one-channel little-endian PFM, whose rows go from the bottom up.
cv::Mat1f readPfm(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string magic;
  int width = 0, height = 0;
  double scale = 0.0;
  stream >> magic >> width >> height >> scale;
  stream.get();
  if (!stream || magic != "Pf" || scale >= 0.0) throw std::runtime_error(file.string());
  cv::Mat1f image(height, width);
  for (int y = height - 1; y >= 0; --y) {
    stream.read(reinterpret_cast<char*>(image[y]), static_cast<std::streamsize>(4) * width);
  }
  if (!stream) throw std::runtime_error(file.string());
  return image;
}

}  // namespace

MiddleburyPair readMiddleburyPair(const std::filesystem::path& folder) {
  MiddleburyPair pair;
  pair.left = cv::imread((folder / "im0.png").string(), cv::IMREAD_COLOR);
  pair.right = cv::imread((folder / "im1.png").string(), cv::IMREAD_COLOR);
  pair.disparity = readPfm(folder / "disp0GT.pfm");
  pair.seen_twice = cv::imread((folder / "mask0nocc.png").string(), cv::IMREAD_GRAYSCALE) == 255;
  pair.camera = readMiddleburyCalibration(folder / "calib.txt").camera();
  pair.disparities = 80;  // ndisp is 64 to 73 in all four
  return pair;
}

MatchQuality matchQuality(const cv::Mat1f& disparity, const MiddleburyPair& pair) {
  int known = 0, found = 0, bad = 0;
  std::vector<double> depth_errors_mm;
  const double scale = 1000.0 * pair.camera.left.fx * pair.camera.baseline_m;
  const auto depth_mm = [&](double d) { return scale / (d + pair.camera.disparity_offset); };
  for (int y = 0; y < disparity.rows; ++y) {
    for (int x = 0; x < disparity.cols; ++x) {
      const double truth = pair.disparity(y, x), d = disparity(y, x);
      if (!std::isfinite(truth) || pair.seen_twice(y, x) == 0) continue;
      ++known;
      if (!std::isfinite(d)) continue;
      ++found;
      bad += std::abs(d - truth) > 2.0 ? 1 : 0;
      depth_errors_mm.push_back(std::abs(depth_mm(d) - depth_mm(truth)));
    }
  }
  const auto middle =
      depth_errors_mm.begin() + static_cast<std::ptrdiff_t>(depth_errors_mm.size() / 2);
  std::nth_element(depth_errors_mm.begin(), middle, depth_errors_mm.end());
  return {static_cast<double>(found) / known, 100.0 * bad / found, *middle};
}

Agreement agreement(const cv::Mat1f& disparity, const cv::Mat1f& reference, const cv::Mat1b& region,
                    double tolerance_px) {
  Agreement a;
  for (int y = 0; y < disparity.rows; ++y) {
    for (int x = 0; x < disparity.cols; ++x) {
      if (region(y, x) == 0) continue;
      ++a.pixels;
      if (!std::isfinite(reference(y, x))) continue;
      ++a.reference;
      if (!std::isfinite(disparity(y, x))) continue;
      ++a.both;
      a.within += std::abs(disparity(y, x) - reference(y, x)) <= tolerance_px ? 1 : 0;
    }
  }
  return a;
}

}  // namespace heel::test
