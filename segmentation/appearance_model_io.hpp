// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Appearance models as files.
#pragma once

#include <heel/segmentation/appearance_model.hpp>

#include <filesystem>

namespace heel {

/// The version of the format that is written; older ones are read.
inline constexpr int kAppearanceFormat = 4;

/// Writes a model as YAML, for people to read too; whole or not at all.
/// @throws std::runtime_error  with one sentence that names the file and the reason.
void saveAppearance(const AppearanceModel& model, const std::filesystem::path& file);

/// Reads what saveAppearance() wrote. Thresholds are the file's, which may have been set by hand.
/// @throws std::runtime_error  with one sentence that names the file and the reason.
AppearanceModel loadAppearance(const std::filesystem::path& file);

}  // namespace heel
