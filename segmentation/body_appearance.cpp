// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "segmentation/body_appearance.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace heel {
namespace {

/// Counts of one band, with the prior taken in.
class Coverage {
 public:
  explicit Coverage(double prior_points) : passed_(0.5 * prior_points), seen_(prior_points) {}

  void add(bool passes) {
    seen_ += 1.0;
    passed_ += passes ? 1.0 : 0.0;
  }
  double share() const { return seen_ > 0.0 ? passed_ / seen_ : 0.5; }

 private:
  double passed_;
  double seen_;
};

/// The upright board at a place, as the camera sees it: for a height, the pixels between two ends.
struct Board {
  Eigen::Vector3d left_foot;  ///< In the base frame, on the floor.
  Eigen::Vector3d right_foot;
};

Board boardAt(const Eigen::Vector2d& position_m, const Eigen::Isometry3d& T_base_camera,
              double half_width_m) {
  const Eigen::Vector2d towards = position_m - T_base_camera.translation().head<2>();
  const double distance = std::max(towards.norm(), 1e-6);
  const Eigen::Vector2d side =
      Eigen::Vector2d(-towards.y(), towards.x()) * (half_width_m / distance);
  const Eigen::Vector2d left = position_m + side;
  const Eigen::Vector2d right = position_m - side;
  return {{left.x(), left.y(), 0.0}, {right.x(), right.y(), 0.0}};
}

/// Where the part of the board between two heights lies in the image; nothing if it crosses the
/// camera's plane, or if the heights leave nothing.
cv::Rect pixelsOf(const Board& board, double min_height_m, double max_height_m,
                  const BodyView& view) {
  if (max_height_m <= min_height_m) return {};
  const Eigen::Isometry3d T_camera_base = view.T_base_camera.inverse();
  double u_min = 1e9, u_max = -1e9, v_min = 1e9, v_max = -1e9;
  for (const Eigen::Vector3d& foot : {board.left_foot, board.right_foot}) {
    for (const double height : {min_height_m, max_height_m}) {
      const Eigen::Vector3d p = T_camera_base * Eigen::Vector3d(foot.x(), foot.y(), height);
      if (p.z() <= 0.1) return {};
      const double u = view.camera.fx * p.x() / p.z() + view.camera.cx;
      const double v = view.camera.fy * p.y() / p.z() + view.camera.cy;
      u_min = std::min(u_min, u);
      u_max = std::max(u_max, u);
      v_min = std::min(v_min, v);
      v_max = std::max(v_max, v);
    }
  }
  const int left = static_cast<int>(std::clamp(std::floor(u_min), -1.0, 1e6));
  const int top = static_cast<int>(std::clamp(std::floor(v_min), -1.0, 1e6));
  const int right = static_cast<int>(std::clamp(std::ceil(u_max), -1.0, 1e6)) + 1;
  const int bottom = static_cast<int>(std::clamp(std::ceil(v_max), -1.0, 1e6)) + 1;
  return cv::Rect(left, top, right - left, bottom - top) &
         cv::Rect(0, 0, view.image_bgr.cols, view.image_bgr.rows);
}

bool isInCylinder(const Eigen::Vector3f& p, const Eigen::Vector2d& position_m,
                  const AppearanceBand& band, double radius_m) {
  const double dx = static_cast<double>(p.x()) - position_m.x();
  const double dy = static_cast<double>(p.y()) - position_m.y();
  return dx * dx + dy * dy <= radius_m * radius_m &&
         static_cast<double>(p.z()) >= band.body.min_height_m &&
         static_cast<double>(p.z()) <= band.body.max_height_m;
}

/// Geometric mean of the shares of the bands that were learned.
template <typename ShareOfBand>
double meanOverBands(const std::vector<AppearanceBand>& bands, const ShareOfBand& share_of) {
  double log_sum = 0.0;
  int learned = 0;
  for (const AppearanceBand& band : bands) {
    if (band.table.empty()) continue;
    log_sum += std::log(std::max(share_of(band), 1e-6));
    ++learned;
  }
  return learned == 0 ? 0.5 : std::exp(log_sum / learned);
}

}  // namespace

double bodyAppearance(const BodyView& view, const WorldBlob& blob,
                      const std::vector<AppearanceBand>& bands,
                      const BodyAppearanceParams& params) {
  const Eigen::Isometry3f T = view.T_base_camera.cast<float>();
  const Board narrow = boardAt(blob.position_m, view.T_base_camera, params.board_half_width_m);
  const Board wide = boardAt(blob.position_m, view.T_base_camera, params.radius_m);
  const double top_m = std::max(blob.max_height_m, params.least_height_m);
  return meanOverBands(bands, [&](const AppearanceBand& band) {
    Coverage coverage(params.prior_points);
    const cv::Rect board =
        pixelsOf(narrow, band.body.min_height_m, std::min(band.body.max_height_m, top_m), view);
    const cv::Rect body =
        pixelsOf(wide, band.body.min_height_m, band.body.max_height_m, view) | board;
    for (int v = body.y; v < body.y + body.height; ++v) {
      const auto* bgr = view.image_bgr.ptr<cv::Vec3b>(v);
      const auto* depth = view.depth_m.ptr<float>(v);
      for (int u = body.x; u < body.x + body.width; ++u) {
        const float z = depth[u];
        const bool is_body =
            z > 0.0F ? isInCylinder(
                           T * Eigen::Vector3f(
                                   (static_cast<float>(u) - static_cast<float>(view.camera.cx)) /
                                       static_cast<float>(view.camera.fx) * z,
                                   (static_cast<float>(v) - static_cast<float>(view.camera.cy)) /
                                       static_cast<float>(view.camera.fy) * z,
                                   z),
                           blob.position_m, band, params.radius_m)
                     : board.contains(cv::Point(u, v));
        if (is_body) coverage.add(band.table.passes(bgr[u][0], bgr[u][1], bgr[u][2]));
      }
    }
    return coverage.share();
  });
}

double bodyAppearance(const ColorCloud& cloud, const WorldBlob& blob,
                      const std::vector<AppearanceBand>& bands,
                      const BodyAppearanceParams& params) {
  return meanOverBands(bands, [&](const AppearanceBand& band) {
    Coverage coverage(params.prior_points);
    for (const auto& p : cloud) {
      if (isInCylinder(p.getVector3fMap(), blob.position_m, band, params.radius_m)) {
        coverage.add(band.table.passes(p.b, p.g, p.r));
      }
    }
    return coverage.share();
  });
}

}  // namespace heel
