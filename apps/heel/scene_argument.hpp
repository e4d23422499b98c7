// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A scene, as users name it.
#pragma once

#include <filesystem>
#include <string>

namespace heel {

/// A scene's file: the path itself, or the name of a scene that comes with Heel.
/// @throws std::runtime_error  if there is neither.
std::filesystem::path sceneFile(const std::string& scene);

}  // namespace heel
