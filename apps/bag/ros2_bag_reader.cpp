// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/bag/ros2_bag_reader.hpp>

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <stdexcept>

namespace heel {
namespace {

namespace fs = std::filesystem;

/// "sensor_msgs/msg/Image" as "sensor_msgs/Image".
std::string withoutMsg(std::string type) {
  const auto at = type.find("/msg/");
  if (at != std::string::npos) type.erase(at, 4);
  return type;
}

/// The files that metadata.yaml lists, else all that there are.
std::vector<fs::path> filesOf(const fs::path& path) {
  if (!fs::is_directory(path)) return {path};
  std::vector<fs::path> files;
  try {
    const YAML::Node about =
        YAML::LoadFile((path / "metadata.yaml").string())["rosbag2_bagfile_information"];
    const auto storage = about["storage_identifier"].as<std::string>("sqlite3");
    if (storage != "sqlite3") {
      throw std::runtime_error(path.string() + ": the bag is in '" + storage +
                               "' storage; we read sqlite3 ('ros2 bag convert' makes one of it)");
    }
    if (!about["compression_format"].as<std::string>("").empty()) {
      throw std::runtime_error(path.string() +
                               ": the bag is compressed by rosbag2; 'ros2 bag convert' unpacks it");
    }
    for (const YAML::Node& name : about["relative_file_paths"]) {
      // Old versions list "bag/bag_0.db3" for what is beside the metadata.
      files.push_back(path / fs::path(name.as<std::string>()).filename());
    }
  } catch (const YAML::Exception&) {
    // The recorder writes it last; without it, all files are the bag's.
  }
  if (!files.empty()) return files;
  for (const auto& entry : fs::directory_iterator(path)) {
    if (entry.path().extension() == ".db3") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return a.native().size() != b.native().size() ? a.native().size() < b.native().size() : a < b;
  });
  if (files.empty()) throw std::runtime_error(path.string() + ": there is no .db3 file in it");
  return files;
}

}  // namespace

Ros2BagReader::Ros2BagReader(const fs::path& path) : name_(path.string()), files_(filesOf(path)) {
  for (const fs::path& file : files_) {
    if (!fs::exists(file)) {
      if (files_.size() == 1) throw std::runtime_error(file.string() + ": the file is missing");
      lose(file.filename().string() + " is missing");
    } else if (fs::is_regular_file(file) && fs::file_size(file) == 0) {
      if (files_.size() == 1)
        throw std::runtime_error(file.string() + ": the bag is empty (0 bytes)");
      lose(file.filename().string() + " is empty");
    }
  }
  if (files_.size() == 1) openFile();  // one that is of no use is an error at once
}

void Ros2BagReader::lose(const std::string& what) {
  ++damages_;
  lost_ = name_ + ": " +
          (damages_ == 1 ? what : "the bag is damaged at " + std::to_string(damages_) + " places") +
          "; what else is there was read";
}

void Ros2BagReader::openFile() {
  const fs::path& path = files_[next_file_++];
  messages_.reset();
  file_.emplace(path, SqliteFile::Use::kRead);
  std::string missing;
  try {
    // A view could work for ever, or make up values of any size.
    for (const char* table : {"topics", "messages"}) {
      if (!file_->hasTable(table)) missing = std::string("it has no table '") + table + "'";
    }
    if (!missing.empty()) throw std::runtime_error(missing);
    readTopics();
    last_id_ = 0;
    messages_.emplace(
        file_->query("SELECT id, topic_id, timestamp, data FROM messages ORDER BY id"));
  } catch (const std::runtime_error&) {
    throw std::runtime_error(path.string() +
                             ": this is no ROS 2 bag, or its beginning is damaged (" +
                             (missing.empty() ? file_->problem() : missing) + ")");
  }
}

void Ros2BagReader::readTopics() {
  topic_of_id_.clear();
  SqliteQuery list = file_->query("SELECT id, name, type, serialization_format FROM topics");
  while (true) {
    const auto row = list.step();
    if (row == SqliteQuery::Row::kBroken) file_->fail();
    if (row == SqliteQuery::Row::kEnd) return;
    if (list.text(3) != "cdr") continue;
    const BagTopic topic{printable(list.text(1)), withoutMsg(printable(list.text(2))), ""};
    const auto known = std::find_if(topics_.begin(), topics_.end(), [&](const BagTopic& other) {
      return other.name == topic.name && other.type == topic.type;
    });
    topic_of_id_[list.integer(0)] = static_cast<std::size_t>(known - topics_.begin());
    if (known == topics_.end()) topics_.push_back(topic);
  }
}

bool Ros2BagReader::next(BagMessage& message) {
  while (true) {
    if (scan_ && nextInScan(message)) return true;
    if (!messages_) {
      if (next_file_ == files_.size()) return false;
      try {
        openFile();
      } catch (const std::runtime_error&) {
        lose(files_[next_file_ - 1].filename().string() + " can't be read");
        messages_.reset();
        continue;
      }
    }
    const auto row = messages_->step();
    // In a damaged file pages may lead to each other, and rows come again and again.
    if (row == SqliteQuery::Row::kThere && messages_->integer(0) > last_id_) {
      last_id_ = messages_->integer(0);
      const auto topic = topic_of_id_.find(messages_->integer(1));
      if (topic == topic_of_id_.end()) continue;
      message.topic = topic->second;
      message.stamp_ns = messages_->integer(2);
      message.data = messages_->blob(3, message.size);
      if (message.data == nullptr && message.size > 0) continue;
      return true;
    }
    if (row == SqliteQuery::Row::kEnd) {
      messages_.reset();
      continue;
    }
    lose(files_[next_file_ - 1].filename().string() + " is damaged or cut off");
    messages_.reset();
    scan_.emplace(files_[next_file_ - 1]);
  }
}

/// Goes on in a damaged file; what came before must not come again.
bool Ros2BagReader::nextInScan(BagMessage& message) {
  while (const auto row = scan_->next()) {
    const auto topic = topic_of_id_.find(row->topic_id);
    if (row->id <= last_id_ || topic == topic_of_id_.end()) continue;
    last_id_ = row->id;
    message = {topic->second, row->stamp_ns, row->data, row->size};
    return true;
  }
  scan_.reset();
  return false;
}

}  // namespace heel
