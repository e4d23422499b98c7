// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Files read and written whole, or not at all.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace heel {

/// All bytes of a file.
/// @throws std::runtime_error  with one sentence that names the file and the reason.
std::string readWholeFile(const std::filesystem::path& file);

/// Writes beside the file, then gives it its name: what was there before stays until all is
/// written.
/// @throws std::runtime_error  with one sentence that names the file and the reason.
void writeWholeFile(const std::filesystem::path& file, std::string_view bytes);

}  // namespace heel
