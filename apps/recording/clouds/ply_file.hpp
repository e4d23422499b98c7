// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// PLY files: what the head says, the points, and writing them.
///
/// PCL's own reader ends the program at properties that it does not expect; its writer makes files
/// that no reader takes where the field rgb is an unsigned number (PCL 1.13).
#pragma once

#include <heel/apps/recording/clouds/cloud_file.hpp>

#include <pcl/PCLPointCloud2.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace heel {

/// A column of such a table.
struct PlyProperty {
  std::string name;
  std::uint8_t type = 0;        ///< As of pcl::PCLPointField.
  std::uint8_t count_type = 0;  ///< Of a list: of the number before its items; 0: no list.
  bool isList() const { return count_type != 0; }
};

/// A table of a PLY file, such as its vertices.
struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

/// All of a PLY file but its data.
struct PlyHeader {
  bool is_binary = false;
  bool is_big_endian = false;
  std::vector<PlyElement> elements;  ///< In the order of their data.
  std::size_t columns = 0;           ///< Of the picture that the points are of; 0: not told.
  std::size_t rows = 0;
  std::size_t bytes = 0;  ///< Where the data begin.

  /// Null if there is none of this name.
  const PlyElement* find(const std::string& name) const;
};

/// @throws std::runtime_error  with one sentence that names the file, if it is no PLY file.
PlyHeader readPlyHeader(const std::filesystem::path& file);

/// The fields that a file's vertices make, and its size; no points. Colours become the field rgb
/// (rgba with alpha), normals normal_x and so on, as PCL has it; lists are left out.
/// @throws std::runtime_error  with one sentence, if the file is too short for what the header
///         says, has no points, or asks for too much memory.
pcl::PCLPointCloud2 plyLayout(const std::filesystem::path& file, const PlyHeader& header);

/// Reads the points, and where the camera was, into `cloud`, whose blob has the layout.
/// @throws std::runtime_error  with one sentence, if the file is too short or damaged.
void readPlyPoints(const std::filesystem::path& file, const PlyHeader& header, CloudFile& cloud);

/// Writes every field, binary, little endian. rgb and rgba become red, green, blue (and alpha);
/// fields of many values become name_0, name_1, ... An organized cloud keeps its shape in the lines
/// "obj_info num_cols" and "num_rows", which PCL reads.
/// @throws std::runtime_error  with one sentence that names the file.
void writePly(const std::filesystem::path& file, const pcl::PCLPointCloud2& blob);

}  // namespace heel
