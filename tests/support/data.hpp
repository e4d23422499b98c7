// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Where the tests find the real recordings, and what other implementations they compare with.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace heel::test {

/// The folder of recordings: the environment's HEEL_DATA, else the one set when Heel was built.
inline std::filesystem::path dataFolder() {
  const char* from_environment = std::getenv("HEEL_DATA");
  return from_environment != nullptr ? from_environment : HEEL_DEFAULT_DATA;
}

/// The folder of npm's packages: the environment's HEEL_NODE_MODULES, else as above.
inline std::string nodeModules() {
  const char* from_environment = std::getenv("HEEL_NODE_MODULES");
  return from_environment != nullptr ? from_environment : HEEL_DEFAULT_NODE_MODULES;
}

inline bool hasNpm(const std::string& package) {
  return !nodeModules().empty() &&
         std::filesystem::exists(std::filesystem::path(nodeModules()) / package);
}
inline const char* const kNoNpm = "HEEL_NODE_MODULES names no folder with npm's ";

}  // namespace heel::test

/// Skips the running test, and says why, when a recording is not there.
#define HEEL_NEED_DATA(name)                                                        \
  if (!std::filesystem::exists(heel::test::dataFolder() / (name))) {                \
    GTEST_SKIP() << "no recording " << (heel::test::dataFolder() / (name)).string() \
                 << "; set HEEL_DATA to the folder that holds it";                  \
  }                                                                                 \
  static_assert(true, "")
