// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// heel live --camera.
#pragma once

#include <heel/apps/camera/pair_camera.hpp>

#include <filesystem>
#include <limits>

namespace heel {

struct LiveCameraOptions {
  PairCameraParams camera;
  std::filesystem::path model;
  int port = 8080;  ///< Of this machine; 0: any that is free.
  double limit_s = std::numeric_limits<double>::infinity();
};

/// Shows who is where in front of a camera, until that or a signal ends it.
void watchCamera(const LiveCameraOptions& options);

}  // namespace heel
