// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// ROS 2 bags in SQLite storage.
#pragma once

#include <heel/apps/bag/bag.hpp>
#include <heel/apps/bag/ros2_page_scan.hpp>
#include <heel/apps/bag/sqlite_file.hpp>

#include <cstdint>
#include <map>
#include <optional>

namespace heel {

/// Reads the files of a ROS 2 bag one after the other, message by message.
class Ros2BagReader final : public BagReader {
 public:
  /// @param path  A folder or a .db3 file.
  /// @throws std::runtime_error  one sentence, if there is none, or the first can't be read at all.
  explicit Ros2BagReader(const std::filesystem::path& path);

  BagForm form() const override { return BagForm::kRos2; }
  bool next(BagMessage& message) override;

 private:
  void openFile();
  void readTopics();
  bool nextInScan(BagMessage& message);
  void lose(const std::string& what);

  std::string name_;
  std::vector<std::filesystem::path> files_;
  std::size_t next_file_ = 0;
  std::optional<SqliteFile> file_;
  std::optional<SqliteQuery> messages_;
  std::optional<Ros2PageScan> scan_;  // goes on where SQLite can't
  std::map<std::int64_t, std::size_t> topic_of_id_;
  std::int64_t last_id_ = 0;
  std::size_t damages_ = 0;
};

}  // namespace heel
