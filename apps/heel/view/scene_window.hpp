// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A window that shows scenes, where there is a display.
#pragma once

#include <heel/apps/heel/view/view_scene.hpp>

#include <memory>
#include <string>

namespace heel {

class SceneWindow {
 public:
  virtual ~SceneWindow() = default;

  /// Shows a scene instead of the last one, for so long; then returns. The view stays as the user
  /// has turned it.
  /// @return false once the user has closed the window.
  virtual bool show(const ViewScene& scene, double seconds) = 0;
};

/// Opens PCL's window. It lies in a library of its own, which is loaded here: nothing else of Heel
/// needs PCL's visualization, or waits for it to load.
/// @param why  Out: why there is none, in a few words.
/// @return Nothing without a display, or where Heel was built without the window.
std::unique_ptr<SceneWindow> openSceneWindow(std::string& why);

}  // namespace heel
