// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// PCD files with colours, checked.
#pragma once

#include <heel/apps/recording/clouds/cloud_file.hpp>

#include <opencv2/core/mat.hpp>

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

/// Writes `pcd.blob`, compressed.
/// @throws std::runtime_error  with one sentence, for instance when the disk is full.
void writePcd(const std::filesystem::path& file, const PcdFile& pcd);

}  // namespace heel
