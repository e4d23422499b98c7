// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>

namespace heel {
namespace {

namespace fs = std::filesystem;
using Folders = std::set<std::string>;

/// What a verb may include: everything but the other verbs.
const Folders kVerb = {"cloud",         "segmentation",    "tracking",        "mapping",
                       "planning",      "apps/output",     "apps/bag",        "apps/recording",
                       "apps/follower", "apps/results",    "apps/pictures",   "apps/film",
                       "apps/pages",    "apps/simulation", "apps/experiment", "apps/heel",
                       "apps/camera",   "apps/live",       "apps/heel/shared"};

/// Which of the others each folder may include. A folder without a row belongs to the one above it.
const std::map<std::string, Folders> kKnows = {
    {"cloud", {}},
    {"segmentation", {"cloud"}},
    {"tracking", {}},
    {"mapping", {"cloud"}},
    {"planning", {"mapping"}},

    {"apps/output", {}},
    {"apps/bag", {"cloud", "apps/output"}},
    {"apps/recording", {"cloud", "mapping", "apps/bag"}},
    {"apps/follower",
     {"cloud", "segmentation", "tracking", "mapping", "planning", "apps/recording"}},

    {"apps/results", {"cloud", "mapping", "planning", "apps/output"}},
    {"apps/pictures", {"cloud", "mapping", "planning", "apps/output"}},
    {"apps/film", {"mapping", "planning", "apps/output", "apps/pictures"}},
    {"apps/pages", {"cloud", "mapping", "apps/output", "apps/pictures", "apps/results"}},
    {"apps/simulation",
     {"cloud", "mapping", "planning", "apps/film", "apps/output", "apps/recording",
      "apps/results"}},
    {"apps/experiment",
     {"cloud", "segmentation", "tracking", "mapping", "planning", "apps/film", "apps/follower",
      "apps/output", "apps/pages", "apps/pictures", "apps/recording", "apps/results",
      "apps/simulation"}},

    {"apps/camera", {"cloud", "apps/recording"}},
    {"apps/live",
     {"cloud", "mapping", "planning", "apps/bag", "apps/follower", "apps/output", "apps/recording",
      "apps/simulation"}},

    {"apps/heel/shared",
     {"cloud", "segmentation", "tracking", "mapping", "planning", "apps/bag", "apps/camera",
      "apps/experiment", "apps/film", "apps/follower", "apps/live", "apps/output", "apps/pages",
      "apps/pictures", "apps/recording", "apps/results", "apps/simulation"}},
    {"apps/heel",
     {"cloud", "segmentation", "mapping", "planning", "apps/camera", "apps/experiment", "apps/film",
      "apps/follower", "apps/live", "apps/output", "apps/pictures", "apps/recording",
      "apps/results", "apps/simulation", "apps/heel/shared"}},
    {"apps/heel/evaluate", kVerb},
    {"apps/heel/experiment", kVerb},
    {"apps/heel/follow", kVerb},
    {"apps/heel/live", kVerb},
    {"apps/heel/inspect", kVerb},
    {"apps/heel/localize", kVerb},
    {"apps/heel/planview", kVerb},
    {"apps/heel/summarize", kVerb},
    {"apps/heel/track", kVerb},
    {"apps/heel/view", kVerb},
};

/// Parts of one library, in folders without rows of their own.
const Folders kWithoutRow = {"apps/recording/bags", "apps/recording/clouds",
                             "apps/recording/folders"};

/// The file that a line includes, from the top of the tree; empty if it includes none of ours.
std::string includedFile(const std::string& line) {
  static const std::regex include("^\\s*#\\s*include\\s*[<\"]heel/([a-z0-9_/.]+)[>\"].*");
  std::smatch match;
  return std::regex_match(line, match, include) ? match[1].str() : std::string();
}

/// The folder with a row that a file belongs to; empty if there is none.
std::string folderOf(fs::path file) {
  do {
    file = file.parent_path();
  } while (kWithoutRow.count(file.generic_string()) == 1);
  return kKnows.count(file.generic_string()) == 1 ? file.generic_string() : std::string();
}

TEST(ModuleDependencies, AFolderIncludesOnlyWhatItMayKnow) {
  const fs::path root = HEEL_SOURCE_DIR;
  int includes = 0;
  for (const char* top : {"cloud", "segmentation", "tracking", "mapping", "planning", "apps"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      const auto extension = entry.path().extension();
      if (extension != ".hpp" && extension != ".cpp") continue;
      const std::string folder = folderOf(fs::relative(entry.path(), root));
      ASSERT_NE(folder, "") << entry.path() << " is in a folder without a row";
      const Folders& known = kKnows.at(folder);
      std::ifstream in(entry.path());
      for (std::string line; std::getline(in, line);) {
        const std::string file = includedFile(line);
        if (file.empty()) continue;
        ++includes;
        EXPECT_TRUE(fs::exists(root / file)) << entry.path() << " includes " << file;
        const std::string other = folderOf(file);
        EXPECT_TRUE(other == folder || known.count(other) == 1)
            << entry.path() << " includes " << file << ", which " << folder << " may not know";
      }
    }
  }
  EXPECT_GT(includes, 500) << "includes have another form than this test reads";
}

TEST(ModuleDependencies, TheArrowsMakeNoCircle) {
  Folders placed;
  for (std::size_t before = 1; placed.size() != before;) {
    before = placed.size();
    for (const auto& [folder, known] : kKnows) {
      if (std::includes(placed.begin(), placed.end(), known.begin(), known.end())) {
        placed.insert(folder);
      }
    }
  }
  EXPECT_EQ(placed.size(), kKnows.size());
}

TEST(ModuleDependencies, WhatIsInstalledKnowsNothingThatIsNot) {
  std::ifstream in(fs::path(HEEL_SOURCE_DIR) / ".cmake" / "heel-config.cmake.in");
  Folders components;
  const std::regex list("foreach\\(_heel_component (cloud .*)\\)");
  std::smatch match;
  for (std::string line; std::getline(in, line);) {
    if (!std::regex_match(line, match, list)) continue;
    std::istringstream names(match[1]);
    for (std::string name; names >> name;) {
      components.insert(kKnows.count(name) == 1 ? name : "apps/" + name);
    }
  }
  ASSERT_GT(components.size(), 5);
  for (const std::string& component : components) {
    ASSERT_EQ(kKnows.count(component), 1) << component;
    for (const std::string& other : kKnows.at(component)) {
      EXPECT_EQ(components.count(other), 1) << component << " may include " << other;
    }
  }
}

TEST(ModuleDependencies, TheCheckSeesAnInclude) {
  EXPECT_EQ(includedFile("#include <heel/mapping/wall_map.hpp>"), "mapping/wall_map.hpp");
  EXPECT_EQ(includedFile("#include \"heel/mapping/wall_map.hpp\""), "mapping/wall_map.hpp");
  EXPECT_EQ(includedFile("#include <mapping/wall_map.hpp>"), "");
  EXPECT_EQ(folderOf("apps/recording/bags/bag_survey.hpp"), "apps/recording");
  EXPECT_EQ(folderOf("apps/new_one/file.hpp"), "");
}

}  // namespace
}  // namespace heel
