// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Scenes and plans by their names.
#pragma once

#include "apps/simulation/scene.hpp"

#include <filesystem>
#include <string>

namespace heel {

/// The folder of the scenes that come with Heel.
std::filesystem::path sceneFolder();

/// A scene from its file, or from those that come with Heel by its name.
/// @throws std::runtime_error  if there is none, and as loadScene().
Scene findScene(const std::string& name);

/// A plan's file: the path itself, or that of a plan that comes with Heel, by its name.
/// @throws std::runtime_error  if there is none.
std::filesystem::path findPlan(const std::string& name);

}  // namespace heel
