// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/shared/scene_argument.hpp>

#include <CLI/CLI.hpp>

#include <stdexcept>

namespace heel {
namespace {

namespace fs = std::filesystem;

fs::path find(const std::string& name, const fs::path& folder, const std::string& extension,
              const std::string& what) {
  if (fs::is_regular_file(name)) return name;  // a folder of this name is none
  const fs::path shipped = folder / (name + extension);
  if (fs::exists(shipped)) return shipped;
  throw std::runtime_error(name + ": there is no such " + what + ", neither as a file nor in " +
                           folder.string());
}

/// What comes with Heel lies at the same place seen from the command, wherever that is.
fs::path shippedFolder(const std::string& name) {
  const fs::path command = fs::read_symlink("/proc/self/exe");
  return fs::weakly_canonical(command.parent_path() / HEEL_DATA_FOLDER / name);
}

}  // namespace

fs::path sceneFolder() { return shippedFolder("scenes"); }

fs::path sceneFile(const std::string& scene) {
  return find(scene, sceneFolder(), ".yaml", "scene");
}

void addLight(CLI::App& verb, std::string& light) {
  verb.add_option("--light", light,
                  "exposure, white balance, gamma, motion blur and flicker: 'fixed', or 'drawn' "
                  "from the seed (default: as the scene says)")
      ->check(CLI::IsMember({"fixed", "drawn"}));
}

void setLight(Scene& scene, const std::string& light) {
  if (!light.empty()) scene.robot.camera.drawn_light = light == "drawn";
}

fs::path mapSource(const std::string& map) {
  const bool is_path = fs::path(map).has_extension() || fs::path(map).has_parent_path();
  return is_path || fs::exists(map) ? fs::path(map) : sceneFile(map);
}

fs::path planFolder() { return shippedFolder("plans"); }

fs::path planFile(const std::string& plan) { return find(plan, planFolder(), ".pnml", "plan"); }

}  // namespace heel
