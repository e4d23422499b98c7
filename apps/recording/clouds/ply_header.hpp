// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What the head of a PLY file says.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace heel {

struct PlyProperty {
  std::string name;
  std::uint8_t type = 0;        ///< As of pcl::PCLPointField.
  std::uint8_t count_type = 0;  ///< Of a list: of the number before its items; 0: no list.
  bool isList() const { return count_type != 0; }
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

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

}  // namespace heel
