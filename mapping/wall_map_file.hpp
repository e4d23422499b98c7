// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Wall maps as OctoMap's binary files (.bt).
#pragma once

#include <heel/mapping/wall_map.hpp>

#include <filesystem>

namespace heel {

/// Writes the map as OctoMap's tools read it, whole or not at all. The map is not changed:
/// OctoMap's own writeBinary would prune and threshold it.
/// @throws std::runtime_error  with one sentence that names the file and the reason.
void saveWallMap(const WallMap& map, const std::filesystem::path& file);

/// Reads a .bt file. It is checked before OctoMap sees it, whose reader goes on with what is left
/// in memory where a file is truncated.
/// @throws std::runtime_error  with one sentence that names the file and the reason: it is not
///         there, is not such a file, is truncated, or goes on after its end.
WallMap loadWallMap(const std::filesystem::path& file);

}  // namespace heel
