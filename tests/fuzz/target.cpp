// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A libFuzzer target for all readers: `fuzz READER [libFuzzer's options] CORPUS...`. Our own seeds
/// to begin with: `fuzz READER --seeds FOLDER`. The readers' names: `fuzz --list`.

#include "tests/fuzz/readers.hpp"
#include "tests/support/temp_folder.hpp"

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <stdexcept>

namespace {

const heel::test::FuzzReader* chosen = nullptr;

[[noreturn]] void list() {
  for (const auto& each : heel::test::fuzzReaders()) std::cout << each.name << "\n";
  std::exit(0);
}

[[noreturn]] void drawSeeds(const std::filesystem::path& folder) {
  const heel::test::TempFolder drawing;
  int number = 0;
  for (const std::string& seed : chosen->seeds(drawing.path())) {
    heel::test::writeText(folder / std::to_string(++number), seed);
  }
  std::exit(0);
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  const std::string name = *argc > 1 ? (*argv)[1] : "";
  if (name == "--list") list();
  const auto& all = heel::test::fuzzReaders();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const auto& each) { return each.name == name; });
  if (found == all.end()) {
    std::cerr << "fuzz: the first word names a reader (fuzz --list), not \"" << name << "\"\n";
    std::exit(2);
  }
  chosen = &*found;
  std::rotate(*argv + 1, *argv + 2, *argv + *argc);  // What is left is libFuzzer's.
  --*argc;
  if (*argc == 3 && std::string((*argv)[1]) == "--seeds") drawSeeds((*argv)[2]);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const heel::test::TempFolder folder;
  try {
    chosen->read(folder.path(), {reinterpret_cast<const char*>(bytes), size});
  } catch (const std::runtime_error&) {
    // A sentence is what bad bytes should get. Whatever else is thrown ends the fuzzer.
  }
  return 0;
}
