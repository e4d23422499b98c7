// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// PCD files with colours, checked.
#pragma once

#include "cloud/color_cloud.hpp"

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <pcl/PCLPointCloud2.h>

#include <filesystem>

namespace heel {

/// A PCD file: all of its fields, and what Heel needs of them.
struct PcdFile {
  pcl::PCLPointCloud2 blob;  ///< Every field of the file.
  Eigen::Vector4f origin = Eigen::Vector4f::Zero();
  Eigen::Quaternionf orientation = Eigen::Quaternionf::Identity();
  ColorCloud cloud;  ///< Its places and colours, point by point.
};

/// Reads a PCD file with colours (fields x, y, z and rgb or rgba; organized or not; ascii, binary
/// or compressed).
/// @throws std::runtime_error  with one sentence that names the file, if it is missing, truncated,
///         or not PCD, has no colours, no points, or none with finite coordinates.
PcdFile readPcd(const std::filesystem::path& file);

/// Looks at the header and the size of a PCD file only.
/// @throws std::runtime_error  as readPcd.
void checkPcd(const std::filesystem::path& file);

/// The colours of an organized cloud as an image (CV_8UC3, BGR).
void colorsOf(const ColorCloud& cloud, cv::Mat& image_bgr);

/// Writes `pcd.blob`, compressed.
/// @throws std::runtime_error  with one sentence, for instance when the disk is full.
void writePcd(const std::filesystem::path& file, const PcdFile& pcd);

}  // namespace heel
