// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/bag/ros2_bag_writer.hpp>
#include <heel/apps/bag/ros2_folder.hpp>
#include <heel/apps/output/output.hpp>

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace heel {
namespace {

namespace fs = std::filesystem;

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

}  // namespace

Ros2BagWriter::Ros2BagWriter(const BagPlan& plan) : is_folder_(plan.path.extension() != ".db3") {
  const OutputKind kind = is_folder_ ? OutputKind::kFolder : OutputKind::kFile;
  output_ =
      std::make_unique<Output>(OutputPlan{plan.by, kind, plan.path, plan.inputs, {}, is_folder_});
  // "name/" is called name
  const fs::path name = plan.path.has_filename() ? plan.path : plan.path.parent_path();
  file_name_ = name.filename().string() + (is_folder_ ? "_0.db3" : "");
  writeWith(*output_ / file_name_, [&](const fs::path& file) {
    file_.emplace(file, SqliteFile::Use::kCreate);
    // Until it has its name nobody else reads it, and after a crash it is of no use.
    file_->run(
        "PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF;"
        "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,"
        " serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);"
        "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL,"
        " timestamp INTEGER NOT NULL, data BLOB NOT NULL);"
        "CREATE INDEX timestamp_idx ON messages (timestamp ASC); BEGIN");
    insert_.emplace(
        file_->query("INSERT INTO messages(topic_id, timestamp, data) VALUES (?, ?, ?)"));
  });
}

Ros2BagWriter::~Ros2BagWriter() = default;

void Ros2BagWriter::add(std::size_t topic) {
  const Topic& about = topics_[topic];
  writeWith(*output_ / file_name_, [&](const fs::path&) {
    file_->query("INSERT INTO topics VALUES (?, ?, ?, 'cdr', ?)")
        .bind(1, static_cast<std::int64_t>(topic + 1))
        .bind(2, about.name)
        .bind(3, withMsg(about.type))
        .bind(4, ros2Qos(about.latched))
        .run();
  });
  counts_.push_back(0);
}

void Ros2BagWriter::put(std::size_t topic, std::int64_t stamp_ns,
                        const std::vector<std::uint8_t>& bytes) {
  writeWith(*output_ / file_name_, [&](const fs::path&) {
    insert_->bind(1, static_cast<std::int64_t>(topic + 1))
        .bind(2, stamp_ns)
        .bind(3, bytes.data(), bytes.size())
        .run();
  });
  first_ns_ = message_count_ == 0 ? stamp_ns : std::min(first_ns_, stamp_ns);
  last_ns_ = message_count_ == 0 ? stamp_ns : std::max(last_ns_, stamp_ns);
  ++counts_[topic];
  ++message_count_;
}

void Ros2BagWriter::writeMetadata() const {
  std::ostringstream out;
  const std::string total = std::to_string(message_count_);
  out << "rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: sqlite3\n"
      << "  duration:\n    nanoseconds: " << last_ns_ - first_ns_ << "\n"
      << "  starting_time:\n    nanoseconds_since_epoch: " << first_ns_ << "\n"
      << "  message_count: " << total << "\n  topics_with_message_count:\n";
  for (std::size_t i = 0; i < topics_.size(); ++i) {
    out << "    - topic_metadata:\n        name: " << topics_[i].name
        << "\n        type: " << withMsg(topics_[i].type)
        << "\n        serialization_format: cdr\n        offered_qos_profiles: "
        << quoted(ros2Qos(topics_[i].latched)) << "\n      message_count: " << counts_[i] << "\n";
  }
  out << "  compression_format: \"\"\n  compression_mode: \"\"\n  relative_file_paths:\n    - "
      << file_name_ << "\n  files:\n    - path: " << file_name_ << "\n      starting_time:"
      << "\n        nanoseconds_since_epoch: " << first_ns_
      << "\n      duration:\n        nanoseconds: " << last_ns_ - first_ns_
      << "\n      message_count: " << total << "\n";
  writeFile(*output_ / "metadata.yaml", out.str());
}

void Ros2BagWriter::commit(bool complete) {
  insert_.reset();
  writeWith(*output_ / file_name_, [&](const fs::path&) {
    file_->run("COMMIT");
    file_->close();
  });
  file_.reset();
  if (is_folder_) writeMetadata();
  output_->commit(complete);
}

}  // namespace heel
