// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

namespace heel {
namespace {

namespace fs = std::filesystem;

/// What each folder may include of the others. What has no row of its own belongs to the folder
/// above it.
const std::map<std::string, std::set<std::string>> kKnows = {
    {"cloud", {}},
    {"segmentation", {"cloud"}},
    {"tracking", {}},
    {"mapping", {"cloud"}},
    {"planning", {"mapping"}},
    {"apps/report", {"cloud", "mapping", "planning"}},
    {"apps/bag", {"cloud", "apps/report"}},
    {"apps/recording", {"cloud", "mapping", "apps/bag"}},
    {"apps/follower",
     {"cloud", "segmentation", "tracking", "mapping", "planning", "apps/recording"}},
    {"apps/simulation", {"cloud", "mapping", "planning", "apps/recording", "apps/report"}},
    {"apps/clouds", {"cloud", "segmentation", "apps/recording", "apps/report"}},
    {"apps/evaluation", {"tracking", "apps/report"}},
    {"apps/mapper",
     {"mapping", "apps/bag", "apps/follower", "apps/recording", "apps/report", "apps/simulation"}},
    {"apps/view", {"cloud", "mapping", "apps/report"}},
    {"apps/experiment",
     {"cloud", "segmentation", "tracking", "mapping", "planning", "apps/follower", "apps/recording",
      "apps/report", "apps/simulation"}},
    {"apps/heel",
     {"cloud", "segmentation", "tracking", "mapping", "planning", "apps/bag", "apps/clouds",
      "apps/evaluation", "apps/experiment", "apps/follower", "apps/mapper", "apps/recording",
      "apps/report", "apps/simulation", "apps/view"}},
};

/// The file that a line includes, from the top of the tree; empty if it includes none of ours.
std::string includedFile(const std::string& line) {
  static const std::regex include("^\\s*#\\s*include\\s*[<\"]heel/([a-z0-9_/.]+)[>\"].*");
  std::smatch match;
  return std::regex_match(line, match, include) ? match[1].str() : std::string();
}

/// The folder with a row that a file belongs to; empty if there is none.
std::string folderOf(fs::path file) {
  while (file.has_parent_path()) {
    file = file.parent_path();
    if (kKnows.count(file.generic_string()) == 1) return file.generic_string();
  }
  return {};
}

TEST(ModuleDependencies, AFolderIncludesOnlyWhatItMayKnow) {
  const fs::path root = HEEL_SOURCE_DIR;
  std::map<std::string, std::set<std::string>> used;
  int includes = 0;
  for (const std::string top :
       {"cloud", "segmentation", "tracking", "mapping", "planning", "apps"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      const auto extension = entry.path().extension();
      if (extension != ".hpp" && extension != ".cpp") continue;
      const std::string folder = folderOf(fs::relative(entry.path(), root));
      EXPECT_NE(folder, "") << entry.path() << " is in a folder without a row";
      used[folder];
      std::ifstream in(entry.path());
      for (std::string line; std::getline(in, line);) {
        const std::string file = includedFile(line);
        if (file.empty()) continue;
        ++includes;
        EXPECT_TRUE(fs::exists(root / file)) << entry.path() << " includes " << file;
        const std::string other = folderOf(file);
        if (other != folder) used[folder].insert(other);
      }
    }
  }
  EXPECT_GT(includes, 500) << "the includes have another form than this test reads";
  EXPECT_EQ(used, kKnows);
}

TEST(ModuleDependencies, TheArrowsMakeNoCircle) {
  std::set<std::string> placed;
  for (std::size_t before = placed.size() + 1; placed.size() != before;) {
    before = placed.size();
    for (const auto& [folder, known] : kKnows) {
      if (std::includes(placed.begin(), placed.end(), known.begin(), known.end())) {
        placed.insert(folder);
      }
    }
  }
  EXPECT_EQ(placed.size(), kKnows.size());
}

TEST(ModuleDependencies, TheCheckSeesAnInclude) {
  EXPECT_EQ(includedFile("#include <heel/mapping/wall_map.hpp>"), "mapping/wall_map.hpp");
  EXPECT_EQ(includedFile("#include \"heel/mapping/wall_map.hpp\""), "mapping/wall_map.hpp");
  EXPECT_EQ(includedFile("#include <mapping/wall_map.hpp>"), "");
  EXPECT_EQ(folderOf("apps/recording/bags/bag_survey.hpp"), "apps/recording");
}

}  // namespace
}  // namespace heel
