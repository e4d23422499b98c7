// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What `heel inspect` tells of bags, clouds and plans.
#pragma once

#include <heel/apps/recording/recording.hpp>

#include <opencv2/core/mat.hpp>

#include <filesystem>

namespace heel {

/// Prints a bag's topics and frames. Whether there is a camera in it, whose recording can be
/// inspected too.
/// @throws std::runtime_error  if the bag can't be read, or has not the topics that are named.
bool inspectBag(const std::filesystem::path& path, const RecordingParams& opening);

/// Depth as colours, from red (near) to blue (6 m and more); black where there is none.
cv::Mat paintDepth(const cv::Mat& depth_m);

/// Tells what a PCD or PLY file holds, and of a camera's cloud how the camera stands.
/// @return  The colours and depths of an organized cloud; empty for others.
/// @throws std::runtime_error  if the file is no cloud, or of no use; see readCloud().
cv::Mat inspectCloud(const std::filesystem::path& file);

/// Tells what kinds of clouds a folder or a pattern names, and, if they are few, of each of them.
/// @throws std::runtime_error  if some can't be used, after it has told of all.
void inspectClouds(const std::filesystem::path& what);

/// Prints what is in a plan and returns it as a picture.
/// @throws std::runtime_error  with one sentence if the file is no sound plan.
cv::Mat inspectPlan(const std::filesystem::path& file);

}  // namespace heel
