// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What `heel inspect` tells of a bag.
#pragma once

#include "apps/recording/recording.hpp"

#include <filesystem>

namespace heel {

/// Prints a bag's topics and frames. Whether there is a camera in it, whose recording can be
/// inspected too.
/// @throws std::runtime_error  if the bag can't be read, or has not the topics that are named.
bool inspectBag(const std::filesystem::path& path, const RecordingParams& opening);

}  // namespace heel
