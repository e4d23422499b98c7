// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/heel/scene_argument.hpp"

#include <stdexcept>

namespace heel {

std::filesystem::path sceneFile(const std::string& scene) {
  namespace fs = std::filesystem;
  if (fs::exists(scene)) return scene;
  const fs::path shipped = fs::path(HEEL_SCENES) / (scene + ".yaml");
  if (fs::exists(shipped)) return shipped;
  throw std::runtime_error(scene + ": there is no such scene, neither as a file nor in " +
                           std::string(HEEL_SCENES));
}

}  // namespace heel
