// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Which pixels of an image are somebody's body.
#pragma once

#include "segmentation/body_appearance.hpp"

#include <opencv2/core/types.hpp>

#include <algorithm>
#include <limits>

namespace heel {

/// Walks over the pixels of a body between two heights, see bodyAppearance() for what they are.
class BodyPixels {
 public:
  /// References must outlive this.
  BodyPixels(const BodyView& view, const WorldBlob& blob, const BodyAppearanceParams& params);

  /// Calls `visit(bgr, height_m, row)` for each; the height is NaN where there is no depth.
  template <typename Visitor>
  void forEach(const BodyBand& band, const Visitor& visit) const;

 private:
  /// Where the part of an upright board of this half width between two heights lies in the image.
  cv::Rect boardIn(double half_width_m, double min_height_m, double max_height_m) const;
  /// The height of a pixel's point if it lies in the body's cylinder between the band's ends.
  bool isInBody(int u, int v, float z, const BodyBand& band, float& height_m) const;

  const BodyView& view_;
  const BodyAppearanceParams& params_;
  Eigen::Isometry3f T_base_camera_;
  Eigen::Isometry3d T_camera_base_;
  Eigen::Vector2d position_m_;
  double top_m_;
};

template <typename Visitor>
void BodyPixels::forEach(const BodyBand& band, const Visitor& visit) const {
  const cv::Rect board =
      boardIn(params_.board_half_width_m, band.min_height_m, std::min(band.max_height_m, top_m_));
  const cv::Rect body = boardIn(params_.radius_m, band.min_height_m, band.max_height_m) | board;
  for (int v = body.y; v < body.y + body.height; ++v) {
    const auto* bgr = view_.image_bgr.ptr<cv::Vec3b>(v);
    const auto* depth = view_.depth_m.ptr<float>(v);
    for (int u = body.x; u < body.x + body.width; ++u) {
      float height_m = std::numeric_limits<float>::quiet_NaN();
      const bool is_body = depth[u] > 0.0F ? isInBody(u, v, depth[u], band, height_m)
                                           : board.contains(cv::Point(u, v));
      if (is_body) visit(bgr[u], height_m, v);
    }
  }
}

}  // namespace heel
