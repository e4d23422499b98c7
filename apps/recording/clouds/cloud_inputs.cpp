// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/clouds/cloud_file.hpp>
#include <heel/apps/recording/clouds/cloud_inputs.hpp>
#include <heel/apps/recording/folders/folder_files.hpp>

#include <glob.h>

#include <algorithm>
#include <memory>
#include <set>
#include <stdexcept>

namespace heel {

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> matching(const std::string& pattern) {
  glob_t found{};
  const int error = glob(pattern.c_str(), 0, nullptr, &found);
  const std::unique_ptr<glob_t, void (*)(glob_t*)> freed(&found, globfree);
  std::vector<fs::path> files;
  if (error == 0) files.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  files.erase(std::remove_if(files.begin(), files.end(),
                             [](const fs::path& file) {
                               return !isCloudName(file) || fs::is_directory(file);
                             }),
              files.end());
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return isBeforeByNumber(a.native(), b.native());
  });
  if (files.empty()) throw std::runtime_error(pattern + ": no PCD or PLY file fits this pattern");
  return files;
}

std::vector<fs::path> cloudsOf(const std::string& name) {
  if (isPattern(name)) return matching(name);
  if (fs::is_directory(name)) {
    auto files = filesIn(name, isCloudName);
    if (files.empty()) throw std::runtime_error(name + ": the folder holds no PCD or PLY file");
    return files;
  }
  if (!isCloudName(name)) {
    throw std::runtime_error(name + ": the name of a cloud ends in .pcd or .ply");
  }
  return {name};
}

}  // namespace

bool isPattern(const std::string& name) {
  return name.find_first_of("*?[") != std::string::npos && !fs::exists(name);
}

std::vector<fs::path> findClouds(const std::vector<std::string>& names) {
  std::vector<fs::path> clouds;
  std::set<fs::path> known;
  for (const std::string& name : names) {
    for (fs::path& file : cloudsOf(name)) {
      if (known.insert(fs::absolute(file).lexically_normal()).second)
        clouds.push_back(std::move(file));
    }
  }
  return clouds;
}

}  // namespace heel
