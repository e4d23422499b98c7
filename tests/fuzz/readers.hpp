// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Every reader of foreign files, as a fuzzer sees it: bytes in, a result or a sentence out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace heel::test {

struct FuzzReader {
  std::string name;
  /// Reads a file of the folder whose only foreign bytes are these.
  /// @throws std::runtime_error  with one sentence, if they are of no use.
  std::function<void(const std::filesystem::path& folder, const std::string& bytes)> read;
  /// Draws what it should read, by our own writers.
  std::function<std::vector<std::string>(const std::filesystem::path& folder)> seeds;
};

const std::vector<FuzzReader>& fuzzReaders();

}  // namespace heel::test
