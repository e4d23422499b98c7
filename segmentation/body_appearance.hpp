// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// How much of a body has the target's colours: the number that tells people apart.
#pragma once

#include "cloud/color_cloud.hpp"
#include "segmentation/appearance_model.hpp"
#include "segmentation/world_blobs.hpp"

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include <vector>

namespace heel {

/// What counts as somebody's body.
struct BodyAppearanceParams {
  double radius_m = 0.20;  ///< Of the cylinder around their place that holds the body.
  /// Where depth is not known: half width of the upright board, facing the camera, whose pixels are
  /// taken for the body's.
  double board_half_width_m = 0.12;
  /// The board reaches up to the blob's height, but at least so high: where somebody's head has not
  /// the target's colours, the blob ends below it.
  double least_height_m = 1.7;
  /// So many points, half of them with the target's colours, are taken to have been seen in each
  /// band beforehand: few points say little, none say 0.5.
  double prior_points = 40.0;
};

/// An image whose pixels may have a depth.
struct BodyView {
  cv::Mat image_bgr;  ///< CV_8UC3.
  cv::Mat depth_m;    ///< CV_32FC1 of the same size, NaN or <= 0 where there is none.
  PinholeCamera camera;
  Eigen::Isometry3d T_base_camera;
};

/// The share of a body's pixels whose colour passes the table of their height's band, as the
/// geometric mean over the bands, in (0, 1); 0.5 says nothing either way. A person in other clothes
/// lets some pixels pass too; what gives them away is all the rest of them.
///
/// A pixel belongs to the body if its point lies in the cylinder around the blob's place and in the
/// band; without a depth, if it lies on the board, which ends at the blob's height (see
/// least_height_m).
/// @param blob  Where the body is, in the base frame, and how high.
double bodyAppearance(const BodyView& view, const WorldBlob& blob,
                      const std::vector<AppearanceBand>& bands,
                      const BodyAppearanceParams& params = {});

/// Whether a point of the base frame lies in the upright cylinder about a place, between the ends
/// of a band of height.
bool isInCylinder(const Eigen::Vector3f& p, const Eigen::Vector2d& position_m, const BodyBand& band,
                  double radius_m);

/// The same over the points of a cloud in the base frame.
double bodyAppearance(const ColorCloud& cloud, const WorldBlob& blob,
                      const std::vector<AppearanceBand>& bands,
                      const BodyAppearanceParams& params = {});

}  // namespace heel
