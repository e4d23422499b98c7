// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A scene as a picture, drawn without a display and without OpenGL.
#pragma once

#include <heel/apps/heel/view/view_scene.hpp>

namespace heel {

/// Draws the cloud point by point, the nearest in front, each as large as the surface that it
/// stands for; over it the blobs on the floor, and the tracks as poles of their height.
///
/// @param picture  Out: CV_8UC3 of 960 x 720; its memory is reused.
void drawScene(const ViewScene& scene, const ViewPoint& from, cv::Mat& picture);

}  // namespace heel
