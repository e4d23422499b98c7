// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What the fuzzers run, a little of it, with any compiler.

#include "tests/fuzz/readers.hpp"
#include "tests/support/temp_folder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace heel::test {
namespace {

class Fuzz : public testing::TestWithParam<FuzzReader> {};

/// Changes bytes, numbers and lengths; the same ones in every run.
std::string changed(std::string bytes, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return n == 0 ? 0 : random() % n; };
  const std::vector<std::string> pieces = {std::string(4, '\xFF'),
                                           std::string(4, '\0'),
                                           "\xFF\xFF\xFF\x7F",
                                           "-1",
                                           "1e308",
                                           "nan",
                                           "4294967296",
                                           "18446744073709551615",
                                           "[",
                                           "\n",
                                           "0"};
  for (std::size_t i = 1 + below(4); i > 0; --i) {
    const std::size_t at = below(bytes.size());
    switch (below(4)) {
      case 0:
        if (!bytes.empty()) bytes[at] = static_cast<char>(below(256));
        break;
      case 1:
        bytes.erase(at, 1 + below(8));
        break;
      case 2:
        bytes.insert(at, pieces[below(pieces.size())]);
        break;
      default:
        const std::size_t digit = std::min(bytes.find_first_of("0123456789", at), bytes.size());
        const std::string& piece = pieces[below(pieces.size())];
        bytes.replace(digit, std::min<std::size_t>(piece.size(), bytes.size() - digit), piece);
    }
  }
  return bytes;
}

/// A result, or one sentence of ours.
void expectBorne(const FuzzReader& reader, const std::string& bytes) {
  const TempFolder folder;
  try {
    reader.read(folder.path(), bytes);
  } catch (const std::runtime_error& error) {
    const std::string why = error.what();
    for (const char* foreign : {"OpenCV(", "yaml-cpp", "std::", "vector", "basic_string"}) {
      EXPECT_EQ(why.find(foreign), std::string::npos) << why;
    }
  }
}

TEST_P(Fuzz, SeedsAreReadAndWhatIsMadeOfThemIsBorne) {
  const TempFolder folder;
  std::mt19937 random(1);
  for (const std::string& seed : GetParam().seeds(folder.path())) {
    const TempFolder alone;
    EXPECT_NO_THROW(GetParam().read(alone.path(), seed));
    for (int i = 0; i < 200; ++i) expectBorne(GetParam(), changed(seed, random));
  }
}

/// What a fuzzer found once.
TEST_P(Fuzz, FindingsAreBorne) {
  const auto folder =
      std::filesystem::path(HEEL_SOURCE_DIR) / "tests/fuzz/findings" / GetParam().name;
  if (!std::filesystem::exists(folder)) return;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    SCOPED_TRACE(file.path().filename());
    expectBorne(GetParam(), readText(file));
  }
}

INSTANTIATE_TEST_SUITE_P(Readers, Fuzz, testing::ValuesIn(fuzzReaders()),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace heel::test
