// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

namespace heel {
namespace {

namespace fs = std::filesystem;

/// Which modules each module may include, besides itself.
const std::map<std::string, std::set<std::string>> kKnows = {
    {"cloud", {}},
    {"segmentation", {"cloud"}},
    {"tracking", {}},
    {"mapping", {"cloud"}},
    {"planning", {"mapping"}},
    {"apps", {"cloud", "segmentation", "tracking", "mapping", "planning"}},
};

/// The module that a line includes; empty if the line includes none of ours.
std::string includedModule(const std::string& line) {
  static const std::regex include("^\\s*#\\s*include\\s*\"([a-z_]+)/.*");
  std::smatch match;
  if (!std::regex_match(line, match, include)) {
    return {};
  }
  return match[1];
}

TEST(ModuleDependencies, AModuleIncludesOnlyWhatItMayKnow) {
  int files = 0;
  for (const auto& [module, known] : kKnows) {
    const fs::path folder = fs::path(HEEL_SOURCE_DIR) / module;
    if (!fs::exists(folder)) {
      continue;
    }
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      const auto extension = entry.path().extension();
      if (extension != ".hpp" && extension != ".cpp") {
        continue;
      }
      ++files;
      std::ifstream in(entry.path());
      for (std::string line; std::getline(in, line);) {
        const std::string other = includedModule(line);
        EXPECT_TRUE(other.empty() || other == module || known.count(other) == 1)
            << entry.path() << " includes " << other << ", which " << module << " may not know";
      }
    }
  }
  EXPECT_GT(files, 20);
}

TEST(ModuleDependencies, TheCheckSeesAnInclude) {
  EXPECT_EQ(includedModule("#include \"mapping/wall_map.hpp\""), "mapping");
  EXPECT_EQ(includedModule("#include <mapping/wall_map.hpp>"), "");
}

}  // namespace
}  // namespace heel
