// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/heel/scene_files.hpp"

#include <stdexcept>

namespace heel {
namespace {

namespace fs = std::filesystem;

fs::path find(const std::string& name, const fs::path& folder, const std::string& extension,
              const std::string& what) {
  if (fs::is_regular_file(name)) return name;
  const fs::path shipped = folder / (name + extension);
  if (fs::exists(shipped)) return shipped;
  throw std::runtime_error(name + ": there is no such " + what + ", neither as a file nor in " +
                           folder.string());
}

}  // namespace

fs::path sceneFolder() { return HEEL_SCENES; }

Scene findScene(const std::string& name) {
  return loadScene(find(name, sceneFolder(), ".yaml", "scene").string());
}

fs::path findPlan(const std::string& name) { return find(name, HEEL_PLANS, ".pnml", "plan"); }

}  // namespace heel
