// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The clouds that a user names: files, folders, wildcards.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace heel {

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
