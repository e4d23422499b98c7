// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A libFuzzer target for the reader HEEL_FUZZ_READER. Without a corpus it begins with our own
/// seeds: `fuzz_pcd --seeds FOLDER` draws them.

#include "tests/fuzz/readers.hpp"
#include "tests/support/temp_folder.hpp"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

namespace {

const heel::test::FuzzReader& reader() {
  const auto& all = heel::test::fuzzReaders();
  return *std::find_if(all.begin(), all.end(),
                       [](const auto& each) { return each.name == HEEL_FUZZ_READER; });
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  if (*argc != 3 || std::string((*argv)[1]) != "--seeds") return 0;
  const std::filesystem::path folder = (*argv)[2];
  const heel::test::TempFolder drawing;
  int number = 0;
  for (const std::string& seed : reader().seeds(drawing.path())) {
    heel::test::writeText(folder / std::to_string(++number), seed);
  }
  std::exit(0);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const heel::test::TempFolder folder;
  try {
    reader().read(folder.path(), {reinterpret_cast<const char*>(bytes), size});
  } catch (const std::runtime_error&) {
    // A sentence is what bad bytes should get. Whatever else is thrown ends the fuzzer.
  }
  return 0;
}
