// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// PCD and PLY files, whatever their fields, checked; and which of them a call names.
#pragma once

#include <heel/cloud/color_cloud.hpp>

#include <Eigen/Geometry>
#include <pcl/PCLPointCloud2.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace heel {

/// How a cloud is stored.
enum class CloudEncoding { kAscii, kBinary, kCompressed };
const char* toText(CloudEncoding encoding);  ///< As PCD names them: "binary_compressed".

/// What a cloud is, without its points.
struct CloudFacts {
  std::string format;  ///< "PCD" or "PLY".
  CloudEncoding encoding = CloudEncoding::kAscii;
  std::string fields;       ///< Their names: "x y z rgb". Padding is left out.
  std::string color_field;  ///< "rgb" or "rgba"; empty: the cloud has no colour.
  std::size_t width = 0;
  std::size_t height = 0;
  std::size_t finite_points = 0;  ///< Those that have a position.

  std::size_t points() const { return width * height; }
  bool isOrganized() const { return height > 1; }
};

/// A PCD or PLY file: all of its fields, and what Heel needs of them.
struct CloudFile {
  CloudFacts facts;
  pcl::PCLPointCloud2 blob;  ///< Every field of the file; places are 32-bit floats.
  Eigen::Vector4f origin = Eigen::Vector4f::Zero();
  Eigen::Quaternionf orientation = Eigen::Quaternionf::Identity();
  ColorCloud cloud;  ///< Its places and colours, point by point; black if it has no colours.
};

/// Whether the name ends as that of a cloud: .pcd or .ply.
bool isCloudName(const std::filesystem::path& file);

/// Reads a PCD or PLY file with fields x, y and z (floats; what has 64 bits gets 32), organized or
/// not, with colours or without.
/// @throws std::runtime_error  with one sentence that names the file, if it is missing, truncated,
///         damaged or no cloud at all, or has no points, or none with finite coordinates.
CloudFile readCloud(const std::filesystem::path& file);

/// @throws std::runtime_error  that names the file, if the cloud has no colours.
void needColors(const std::filesystem::path& file, const CloudFacts& facts);

/// Looks at the header and the size of a PCD file only.
/// @throws std::runtime_error  as readCloud.
CloudFacts checkPcdFile(const std::filesystem::path& file);

/// Writes `cloud.blob`: as PLY (binary) if the name says so, else as PCD, compressed.
/// @throws std::runtime_error  with one sentence, for instance when the disk is full.
void writeCloud(const std::filesystem::path& file, const CloudFile& cloud);

/// Whether a name is a pattern (it has *, ? or [) and not a file that is really called so.
bool isPattern(const std::string& name);

/// The PCD and PLY files behind what was named: a file is itself, there or not; a folder is all of
/// them right in it; a pattern is the files that fit it ("clouds/*.pcd", see glob(7)). In the order
/// in which they were named, a folder's and a pattern's by number ("9.pcd" before "10.pcd"); a file
/// that is named twice comes once.
/// @throws std::runtime_error  if a folder has none, nothing fits a pattern, or a file's name does
///         not end in .pcd or .ply.
std::vector<std::filesystem::path> findClouds(const std::vector<std::string>& names);

}  // namespace heel
