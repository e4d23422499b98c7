// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/bag/ros2_folder.hpp>

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <stdexcept>

namespace heel {

namespace fs = std::filesystem;

namespace {

/// The files that metadata.yaml lists; none if there is no such list.
std::vector<fs::path> listedFiles(const fs::path& folder) {
  std::vector<fs::path> files;
  const fs::path metadata = folder / "metadata.yaml";
  if (!fs::is_regular_file(metadata)) return files;
  try {
    const YAML::Node about = YAML::LoadFile(metadata.string())["rosbag2_bagfile_information"];
    const auto storage = about["storage_identifier"].as<std::string>("sqlite3");
    if (storage != "sqlite3" && storage != "mcap") {
      throw std::runtime_error(folder.string() + ": the bag is in '" + storage +
                               "' storage; we read sqlite3 and mcap ('ros2 bag convert' makes one "
                               "of it)");
    }
    if (!about["compression_format"].as<std::string>("").empty()) {
      throw std::runtime_error(folder.string() +
                               ": the bag is compressed by rosbag2; 'ros2 bag convert' unpacks it");
    }
    for (const YAML::Node& name : about["relative_file_paths"]) {
      // Old versions list "bag/bag_0.db3" for what is beside the metadata.
      files.push_back(folder / fs::path(name.as<std::string>()).filename());
    }
  } catch (const YAML::Exception&) {
    // The recorder writes it last; without it, all files are the bag's.
  }
  return files;
}

}  // namespace

bool isRos2File(const fs::path& path) {
  return path.extension() == ".db3" || path.extension() == ".mcap";
}

std::vector<fs::path> ros2Files(const fs::path& path) {
  if (!fs::is_directory(path)) return {path};
  std::vector<fs::path> files = listedFiles(path);
  if (files.empty()) {
    for (const auto& entry : fs::directory_iterator(path)) {
      if (isRos2File(entry.path())) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
      return a.native().size() != b.native().size() ? a.native().size() < b.native().size() : a < b;
    });
  }
  if (files.empty()) {
    throw std::runtime_error(path.string() + ": there is no .db3 or .mcap file in it");
  }
  const fs::path kind = files.front().extension();
  files.erase(std::remove_if(files.begin(), files.end(),
                             [&](const fs::path& file) { return file.extension() != kind; }),
              files.end());
  return files;
}

std::string withMsg(std::string type) { return type.insert(type.find('/'), "/msg"); }

std::string withoutMsg(std::string type) {
  const auto at = type.find("/msg/");
  if (at != std::string::npos) type.erase(at, 4);
  return type;
}

std::string ros2Qos(bool latched) {
  const std::string forever = "\n    sec: 9223372036\n    nsec: 854775807\n";
  return "- history: 1\n  depth: " + std::string(latched ? "1" : "10") +
         "\n  reliability: 1\n  durability: " + (latched ? "1" : "2") + "\n  deadline:" + forever +
         "  lifespan:" + forever + "  liveliness: 1\n  liveliness_lease_duration:" + forever +
         "  avoid_ros_namespace_conventions: false";
}

}  // namespace heel
