// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Bags of ROS 1 that their recorder has split.
#pragma once

#include <filesystem>
#include <vector>

namespace heel {

/// X.bag, and what a recorder calls a bag that it has not closed: X.bag.active.
bool isRos1File(const std::filesystem::path& path);

/// Whether a folder has bags of ROS 1 in it and, but for texts and hidden files, nothing else: what
/// has more is a recording of another kind, or results.
bool isRos1Folder(const std::filesystem::path& path);

/// The bags in such a folder, in the order of the times when they begin.
/// @throws std::runtime_error  one sentence, if two were recorded at the same time: then they are
/// no
///         pieces of one.
std::vector<std::filesystem::path> ros1Files(const std::filesystem::path& folder);

}  // namespace heel
