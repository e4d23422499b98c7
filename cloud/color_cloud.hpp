// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The coloured cloud that travels between Heel's stages, and how images become one.
#pragma once

#include "cloud/pinhole_camera.hpp"

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/types.h>

namespace heel {

using ColorCloud = pcl::PointCloud<pcl::PointXYZRGB>;

/// Turns a depth image and the colours beside it into an organized cloud.
///
/// @param depth_m        CV_32FC1, metres along the optical axis; NaN (or <= 0) where there is
/// none.
/// @param image_bgr      CV_8UC3 of the same size.
/// @param T_base_camera  Maps points of the camera's optical frame to the frame of the cloud.
/// @param cloud          Out: organized like the image, NaN where there is no depth; its memory is
///                       reused.
/// @throws std::invalid_argument  if the sizes or types do not fit.
void makeColorCloud(const cv::Mat& depth_m, const cv::Mat& image_bgr, const PinholeCamera& camera,
                    const Eigen::Isometry3d& T_base_camera, ColorCloud& cloud);

/// The same, only for the pixels where `mask` (CV_8UC1) is not 0: all other points are NaN.
/// `indices` lists the points that have a position, in order. The cost beyond the blanking of the
/// cloud follows the number of masked pixels.
void makeColorCloud(const cv::Mat& depth_m, const cv::Mat& image_bgr, const cv::Mat& mask,
                    const PinholeCamera& camera, const Eigen::Isometry3d& T_base_camera,
                    ColorCloud& cloud, pcl::Indices& indices);

}  // namespace heel
