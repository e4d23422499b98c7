// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Clouds as PLY files. PCL's own writer makes files that no reader takes where the field rgb is an
/// unsigned number (PCL 1.13).
#pragma once

#include <pcl/PCLPointCloud2.h>

#include <filesystem>

namespace heel {

/// Writes every field, binary, little endian. rgb and rgba become red, green, blue (and alpha);
/// fields of many values become name_0, name_1, ... An organized cloud keeps its shape in the lines
/// "obj_info num_cols" and "num_rows", which PCL reads.
/// @throws std::runtime_error  with one sentence that names the file.
void writePly(const std::filesystem::path& file, const pcl::PCLPointCloud2& blob);

}  // namespace heel
