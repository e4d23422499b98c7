// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What `heel inspect` tells of a plan.
#pragma once

#include <opencv2/core/mat.hpp>

#include <filesystem>

namespace heel {

/// Prints what is in a plan and returns it as a picture.
/// @throws std::runtime_error  with one sentence if the file is no sound plan.
cv::Mat inspectPlan(const std::filesystem::path& file);

}  // namespace heel
