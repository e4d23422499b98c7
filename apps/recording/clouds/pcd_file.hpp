// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// PCD files with colours, checked.
#pragma once

#include <heel/apps/recording/clouds/cloud_file.hpp>

#include <opencv2/core/mat.hpp>

#include <cstddef>
#include <filesystem>

namespace heel {

using PcdFile = CloudFile;

/// Reads a PCD file with colours (fields x, y, z and rgb or rgba; organized or not; ascii, binary
/// or compressed).
/// @throws std::runtime_error  as readCloud, and if it has no colours.
PcdFile readPcd(const std::filesystem::path& file);

/// Looks at the header and the size of a PCD file only.
/// @throws std::runtime_error  as readPcd.
void checkPcd(const std::filesystem::path& file);

/// The colours of an organized cloud as an image (CV_8UC3, BGR).
void colorsOf(const ColorCloud& cloud, cv::Mat& image_bgr);

/// All of a PCD file but its points.
struct PcdHeader {
  pcl::PCLPointCloud2 layout;  ///< Fields and sizes; no points.
  Eigen::Vector4f origin = Eigen::Vector4f::Zero();
  Eigen::Quaternionf orientation = Eigen::Quaternionf::Identity();
  CloudEncoding encoding = CloudEncoding::kAscii;
  std::size_t data_start = 0;
  std::size_t points = 0;
  std::size_t values = 0;        ///< Of a point, in ascii.
  std::size_t stored_bytes = 0;  ///< Of a point, compressed: padding, named "_", is left out.
};

/// @throws std::runtime_error  with one sentence that names the file, if it is no PCD file, or one
///         whose sizes contradict each other.
PcdHeader readPcdHeader(const std::filesystem::path& file);

/// What the header asks for is held to what the file has, and to the memory that it may take.
/// @throws std::runtime_error  with one sentence, if the file is too short or asks for too much.
void checkPcdSize(const std::filesystem::path& file, const PcdHeader& header);

/// Reads the points of a file whose size was checked, into `cloud`.
/// @return whether they could all be read.
bool readPcdPoints(const std::filesystem::path& file, const PcdHeader& header,
                   pcl::PCLPointCloud2& cloud);

}  // namespace heel
