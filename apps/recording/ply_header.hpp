// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What the head of a PLY file says.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace heel {

struct PlyProperty {
  std::string name;
  std::string type;       ///< "float32" and the like; "float" is "float32" here.
  std::size_t bytes = 0;  ///< 0: a list, whose size the header does not tell.
};

struct PlyHeader {
  bool is_binary = false;
  std::size_t vertices = 0;
  bool vertices_first = false;       ///< No other element comes before them.
  std::vector<PlyProperty> columns;  ///< Of a vertex.
  std::size_t bytes = 0;             ///< Where the data begin.
};

/// @throws std::runtime_error  with one sentence that names the file, if it is no PLY file.
PlyHeader readPlyHeader(const std::filesystem::path& file);

/// Reads past the header what has to be there: PCL's reader allocates what the header asks for.
/// @throws std::runtime_error  with one sentence, if the file is too short.
void checkPlySize(const std::filesystem::path& file, const PlyHeader& header);

}  // namespace heel
