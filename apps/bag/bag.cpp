// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/bag/bag.hpp>
#include <heel/apps/bag/ros1_folder.hpp>
#include <heel/apps/bag/ros2_folder.hpp>
#ifdef HEEL_HAS_BAGS
#include <heel/apps/bag/bag_sequence.hpp>
#include <heel/apps/bag/mcap_bag_reader.hpp>
#include <heel/apps/bag/mcap_bag_writer.hpp>
#include <heel/apps/bag/ros1_bag_reader.hpp>
#include <heel/apps/bag/ros1_bag_writer.hpp>
#include <heel/apps/bag/ros2_bag_reader.hpp>
#include <heel/apps/bag/ros2_bag_writer.hpp>
#endif

#include <algorithm>
#include <stdexcept>

namespace heel {

namespace fs = std::filesystem;

namespace {

bool holdsBagFile(const fs::path& folder) {
  return std::any_of(fs::directory_iterator(folder), fs::directory_iterator(),
                     [](const auto& entry) { return isRos2File(entry.path()); });
}

}  // namespace

std::string printable(std::string_view name) {
  std::string text(name);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

bool BagReader::wants(const std::string& topic) const {
  return query_.topics.empty() ||
         std::find(query_.topics.begin(), query_.topics.end(), topic) != query_.topics.end();
}

bool isBag(const fs::path& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    return fs::exists(path / "metadata.yaml") || holdsBagFile(path) || isRos1Folder(path);
  }
  return isRos1File(path) || isRos2File(path);
}

#ifdef HEEL_HAS_BAGS

std::unique_ptr<BagReader> openBag(const fs::path& path) {
  if (!fs::exists(path)) throw std::runtime_error(path.string() + ": there is no such bag");
  if (fs::is_directory(path) && isRos1Folder(path)) {
    return std::make_unique<BagSequence>(path, ros1Files(path));
  }
  if (isRos1File(path)) return std::make_unique<Ros1BagReader>(path);
  const std::vector<fs::path> files = ros2Files(path);
  if (files.front().extension() != ".mcap") return std::make_unique<Ros2BagReader>(path, files);
  if (files.size() == 1) return std::make_unique<McapBagReader>(files.front());
  return std::make_unique<BagSequence>(path, files);
}

std::unique_ptr<BagWriter> createBag(const BagPlan& plan) {
  if (plan.path.extension() == ".bag") return std::make_unique<Ros1BagWriter>(plan);
  if (plan.path.extension() == ".mcap") return std::make_unique<McapBagWriter>(plan);
  return std::make_unique<Ros2BagWriter>(plan);
}

#else

std::unique_ptr<BagReader> openBag(const fs::path& path) {
  throw std::runtime_error(path.string() +
                           ": this build of Heel reads no bags (cmake -DHEEL_WITH_BAGS=ON)");
}

std::unique_ptr<BagWriter> createBag(const BagPlan& plan) {
  throw std::runtime_error(plan.path.string() +
                           ": this build of Heel writes no bags (cmake -DHEEL_WITH_BAGS=ON)");
}

#endif

}  // namespace heel
