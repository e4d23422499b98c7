// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Scenes, maps and plans, as users name them.
#pragma once

#include <heel/apps/simulation/scene.hpp>

#include <filesystem>
#include <string>

namespace CLI {
class App;
}

namespace heel {

/// The folder of the scenes that come with Heel.
std::filesystem::path sceneFolder();

/// A scene's file: the path itself, or the name of a scene that comes with Heel.
/// @throws std::runtime_error  if there is neither.
std::filesystem::path sceneFile(const std::string& scene);

/// Adds --light: 'fixed' or 'drawn'; empty is as the scene says.
void addLight(CLI::App& verb, std::string& light);

/// Gives the scene's camera that light.
void setLight(Scene& scene, const std::string& light);

/// What a map is made of: a path, or the name of a scene that comes with Heel; see openMap().
/// @throws std::runtime_error  if it is a name, and there is no such scene.
std::filesystem::path mapSource(const std::string& map);

/// The folder of the plans that come with Heel.
std::filesystem::path planFolder();

/// A plan's PNML file: the path itself, or the name of a plan that comes with Heel.
/// @throws std::runtime_error  if there is neither.
std::filesystem::path planFile(const std::string& plan);

}  // namespace heel
