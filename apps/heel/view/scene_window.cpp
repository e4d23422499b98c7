// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/view/scene_window.hpp>

#include <dlfcn.h>

namespace heel {

std::unique_ptr<SceneWindow> openSceneWindow(std::string& why) {
  // Never closed: VTK does not take it well.
  void* library = dlopen("libheel_window.so", RTLD_NOW | RTLD_LOCAL);
  using Open = SceneWindow* (*)();
  void* symbol = library == nullptr ? nullptr : dlsym(library, "heelOpenSceneWindow");
  if (symbol == nullptr) {
    why = "Heel's window is not installed";
    return nullptr;
  }
  std::unique_ptr<SceneWindow> window(reinterpret_cast<Open>(symbol)());
  if (window == nullptr) why = "there is no display";
  return window;
}

}  // namespace heel
