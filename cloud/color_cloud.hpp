// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The coloured cloud that travels between Heel's stages, and how images become one.
#pragma once

#include <heel/cloud/pinhole_camera.hpp>
#include <heel/cloud/row_spans.hpp>

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/types.h>

#include <optional>

namespace heel {

using ColorCloud = pcl::PointCloud<pcl::PointXYZRGB>;

/// Turns disparities (CV_32FC1, NaN where there is none) into depths (the same), as StereoCamera
/// says. Disparities of points at or behind infinity become NaN.
/// @throws std::invalid_argument  if the type is wrong or the camera has no baseline.
void disparityToDepth(const cv::Mat& disparity, const StereoCamera& camera, cv::Mat& depth_m);

/// Turns a depth image and the colours beside it into an organized cloud.
///
/// @param depth_m        CV_32FC1, metres along the optical axis; NaN (or <= 0) where there is
///                       none.
/// @param image_bgr      CV_8UC3 of the same size.
/// @param T_base_camera  Maps points of the camera's optical frame to the frame of the cloud.
/// @param cloud          Out: organized like the image, NaN where there is no depth; its memory is
///                       reused.
/// @throws std::invalid_argument  if the sizes or types do not fit, or a focal length is not > 0.
void makeColorCloud(const cv::Mat& depth_m, const cv::Mat& image_bgr, const PinholeCamera& camera,
                    const Eigen::Isometry3d& T_base_camera, ColorCloud& cloud);

/// The same, only for the pixels where `mask` (CV_8UC1) is not 0: all other points are NaN and
/// black. `indices` lists the points that have a position, in order. For one frame; for a stream,
/// a MaskedCloud does the same without rewriting the whole cloud.
void makeColorCloud(const cv::Mat& depth_m, const cv::Mat& image_bgr, const cv::Mat& mask,
                    const PinholeCamera& camera, const Eigen::Isometry3d& T_base_camera,
                    ColorCloud& cloud, pcl::Indices& indices);

/// The masked cloud of each frame of a stream, at a cost that follows the number of masked pixels:
/// of the previous frame's cloud, only the points that had a position are blanked. Not to be
/// copied: a copy would write into the same cloud.
class MaskedCloud {
 public:
  MaskedCloud();
  MaskedCloud(const MaskedCloud&) = delete;
  MaskedCloud& operator=(const MaskedCloud&) = delete;
  MaskedCloud(MaskedCloud&&) = default;
  MaskedCloud& operator=(MaskedCloud&&) = default;

  /// As makeColorCloud with a mask.
  void update(const cv::Mat& depth_m, const cv::Mat& image_bgr, const cv::Mat& mask,
              const PinholeCamera& camera, const Eigen::Isometry3d& T_base_camera);

  /// Organized; NaN and black outside of `indices()`. The next update changes it.
  ColorCloud::ConstPtr cloud() const { return cloud_; }

  /// The points that have a position, in order.
  const pcl::Indices& indices() const { return indices_; }

 private:
  ColorCloud::Ptr cloud_;
  pcl::Indices indices_;
  RowSpans spans_;
};

/// Fits u = fx X / Z + cx and v = fy Y / Z + cy to an organized cloud in the optical frame, by
/// least squares over all its points.
///
/// @return The camera, or nothing if the cloud is not organized, has less than three points or all
///         in one row or column, which determine no camera, or does not come from one pinhole
///         camera (the residual is over half a pixel, root mean square).
std::optional<PinholeCamera> fitPinhole(const ColorCloud& cloud);

}  // namespace heel
