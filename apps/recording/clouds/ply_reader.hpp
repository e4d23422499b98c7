// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The points of a PLY file. PCL's own reader ends the program at properties that it does not
/// expect.
#pragma once

#include <heel/apps/recording/clouds/cloud_file.hpp>
#include <heel/apps/recording/clouds/ply_header.hpp>

#include <filesystem>

namespace heel {

/// The fields that a file's vertices make, and its size; no points. Colours become the field rgb
/// (rgba with alpha), normals normal_x and so on, as PCL has it; lists are left out.
/// @throws std::runtime_error  with one sentence, if the file is too short for what the header
/// says,
///         has no points, or asks for too much memory.
pcl::PCLPointCloud2 plyLayout(const std::filesystem::path& file, const PlyHeader& header);

/// Reads the points, and where the camera was, into `cloud`, whose blob has the layout.
/// @throws std::runtime_error  with one sentence, if the file is too short or damaged.
void readPlyPoints(const std::filesystem::path& file, const PlyHeader& header, CloudFile& cloud);

}  // namespace heel
