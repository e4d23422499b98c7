// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The files of a folder in the order of their numbers.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>
#include <vector>

namespace heel {

/// Whether `a` comes before `b`; digits count as a number, so that "left9" is before "left10".
bool isBeforeByNumber(std::string_view a, std::string_view b);

/// The folder's files whose path `takes` accepts, in the order of isBeforeByNumber(); none if there
/// is no such folder.
std::vector<std::filesystem::path> filesIn(
    const std::filesystem::path& folder,
    const std::function<bool(const std::filesystem::path&)>& takes);

}  // namespace heel
