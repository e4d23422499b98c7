// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Rendered stereo pairs whose disparities are known exactly.
#pragma once

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>

#include <cstdint>
#include <vector>

namespace heel::test {

/// A textured part of a plane. Seen from the left camera, a plane's disparity is linear in the
/// pixel: disparity + slope_u * u + slope_v * v.
struct Surface {
  cv::Rect2d area;  ///< In the left image; what it covers there, if nothing is nearer.
  double disparity = 0.0;
  double slope_u = 0.0;
  double slope_v = 0.0;
  cv::Scalar colour_bgr = {128, 128, 128};
  double contrast = 60.0;  ///< Of the texture, in grey levels each way.
};

struct StereoScene {
  cv::Mat left, right;   ///< CV_8UC3.
  cv::Mat1f disparity;   ///< Exact, of every left pixel.
  cv::Mat1b seen_twice;  ///< 255 where the right image sees the left pixel's point, too.
  cv::Mat1b surface;     ///< Index of the surface that a left pixel shows.
};

/// Renders the nearest surface at each pixel of both images, with `noise` grey levels (standard
/// deviation) of independent noise. Surface 0 must fill the image.
StereoScene render(const std::vector<Surface>& surfaces, cv::Size size = {640, 480},
                   double noise = 2.0, std::uint64_t seed = 1);

/// A room: back wall, floor, a cupboard, a table, and a person of some 7 % of the image
/// (surfaces kPersonFirst and up).
std::vector<Surface> roomWithPerson();
constexpr int kPersonFirst = 4;

}  // namespace heel::test
