// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/bag/ros2_bag_writer.hpp"

#include "apps/report/atomic_file.hpp"

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <utility>

namespace heel {
namespace {

namespace fs = std::filesystem;

/// "sensor_msgs/Image" as "sensor_msgs/msg/Image".
std::string withMsg(std::string type) { return type.insert(type.find('/'), "/msg"); }

/// Quality of service, as rosbag2 writes it: reliable; who comes late gets the last message if
/// `latched`.
std::string qosOf(bool latched) {
  const std::string forever = "\n    sec: 9223372036\n    nsec: 854775807\n";
  return "- history: 1\n  depth: " + std::string(latched ? "1" : "10") +
         "\n  reliability: 1\n  durability: " + (latched ? "1" : "2") + "\n  deadline:" + forever +
         "  lifespan:" + forever + "  liveliness: 1\n  liveliness_lease_duration:" + forever +
         "  avoid_ros_namespace_conventions: false";
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '\n') {
      result += "\\n";
    } else {
      result += c;
    }
  }
  return result + "\"";
}

/// Whether a folder may be replaced: it holds nothing, or a bag.
bool mayReplace(const fs::path& folder) {
  return !fs::exists(folder) || (fs::is_directory(folder) &&
                                 (fs::is_empty(folder) || fs::exists(folder / "metadata.yaml")));
}

}  // namespace

Ros2BagWriter::Ros2BagWriter(fs::path path)
    : path_(std::move(path)), is_folder_(path_.extension() != ".db3") {
  if (path_.filename().empty()) path_ = path_.parent_path();  // it was given as "name/"
  temporary_ = temporaryBeside(path_);
  fs::path database = temporary_;
  std::error_code problem;
  fs::remove_all(temporary_, problem);
  if (is_folder_) {
    if (!mayReplace(path_)) {
      throw std::runtime_error(path_.string() + ": there is something else of that name already");
    }
    file_name_ = path_.filename().string() + "_0.db3";
    database /= file_name_;
    fs::create_directories(temporary_, problem);
    if (problem) throw std::runtime_error(path_.string() + ": can't be made: " + problem.message());
  }
  file_.emplace(database, SqliteFile::Use::kCreate);
  // Until it has its name nobody else reads it, and after a crash it is of no use.
  file_->run(
      "PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF;"
      "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,"
      " serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);"
      "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL,"
      " timestamp INTEGER NOT NULL, data BLOB NOT NULL);"
      "CREATE INDEX timestamp_idx ON messages (timestamp ASC); BEGIN");
  insert_.emplace(file_->query("INSERT INTO messages(topic_id, timestamp, data) VALUES (?, ?, ?)"));
}

Ros2BagWriter::~Ros2BagWriter() {
  if (finished_) return;
  insert_.reset();
  file_.reset();
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);
}

void Ros2BagWriter::add(std::size_t topic) {
  const Topic& about = topics_[topic];
  file_->query("INSERT INTO topics VALUES (?, ?, ?, 'cdr', ?)")
      .bind(1, static_cast<std::int64_t>(topic + 1))
      .bind(2, about.name)
      .bind(3, withMsg(about.type))
      .bind(4, qosOf(about.latched))
      .run();
  counts_.push_back(0);
}

void Ros2BagWriter::put(std::size_t topic, std::int64_t stamp_ns,
                        const std::vector<std::uint8_t>& bytes) {
  insert_->bind(1, static_cast<std::int64_t>(topic + 1))
      .bind(2, stamp_ns)
      .bind(3, bytes.data(), bytes.size())
      .run();
  first_ns_ = message_count_ == 0 ? stamp_ns : std::min(first_ns_, stamp_ns);
  last_ns_ = message_count_ == 0 ? stamp_ns : std::max(last_ns_, stamp_ns);
  ++counts_[topic];
  ++message_count_;
}

void Ros2BagWriter::writeMetadata() const {
  std::ofstream out(temporary_ / "metadata.yaml");
  const std::string total = std::to_string(message_count_);
  out << "rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: sqlite3\n"
      << "  duration:\n    nanoseconds: " << last_ns_ - first_ns_ << "\n"
      << "  starting_time:\n    nanoseconds_since_epoch: " << first_ns_ << "\n"
      << "  message_count: " << total << "\n  topics_with_message_count:\n";
  for (std::size_t i = 0; i < topics_.size(); ++i) {
    out << "    - topic_metadata:\n        name: " << topics_[i].name
        << "\n        type: " << withMsg(topics_[i].type)
        << "\n        serialization_format: cdr\n        offered_qos_profiles: "
        << quoted(qosOf(topics_[i].latched)) << "\n      message_count: " << counts_[i] << "\n";
  }
  out << "  compression_format: \"\"\n  compression_mode: \"\"\n  relative_file_paths:\n    - "
      << file_name_ << "\n  files:\n    - path: " << file_name_ << "\n      starting_time:"
      << "\n        nanoseconds_since_epoch: " << first_ns_
      << "\n      duration:\n        nanoseconds: " << last_ns_ - first_ns_
      << "\n      message_count: " << total << "\n";
  out.close();
  if (!out) throw std::runtime_error(path_.string() + " cannot be written: is the disk full?");
}

void Ros2BagWriter::commit() {
  insert_.reset();
  file_->run("COMMIT");
  file_->close();
  file_.reset();
  if (is_folder_) {
    writeMetadata();
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  commitTemporary(temporary_, path_);
  finished_ = true;
}

}  // namespace heel
