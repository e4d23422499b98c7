// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A model of the small recording's person, without a run of `heel learn`.
#pragma once

#include <filesystem>

namespace heel::test {

void writeSmallModel(const std::filesystem::path& file);

}  // namespace heel::test
