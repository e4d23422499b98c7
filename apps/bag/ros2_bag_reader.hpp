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
#include <string>
#include <utility>
#include <vector>

namespace heel {

/// Reads the files of a ROS 2 bag one after the other, each in the order of time.
class Ros2BagReader final : public BagReader {
 public:
  /// @param path   A folder or a .db3 file, for messages.
  /// @param files  The files of it.
  /// @throws std::runtime_error  one sentence, if there is one and it can't be read at all.
  Ros2BagReader(const std::filesystem::path& path, std::vector<std::filesystem::path> files);

  BagForm form() const override { return BagForm::kRos2; }
  const BagIndex* index() override;
  void select(const BagQuery& query) override;
  bool next(BagMessage& message) override;

 private:
  void openFile();
  void readTopics();
  void goOnInScan(const std::string& why);
  bool measure(BagIndex& index);
  std::string condition() const;
  bool isNew(std::int64_t stamp_ns, std::int64_t id);
  bool nextInFile(BagMessage& message);
  bool nextInScan(BagMessage& message);
  void lose(const std::string& what);

  std::string name_;
  std::vector<std::filesystem::path> files_;
  std::size_t next_file_ = 0;
  std::optional<SqliteFile> file_;
  std::optional<SqliteQuery> order_;     // numbers and times of rows
  std::optional<SqliteQuery> messages_;  // a row by its number
  std::optional<Ros2PageScan> scan_;     // goes on where SQLite can't
  std::map<std::int64_t, std::size_t> topic_of_id_;
  std::pair<std::int64_t, std::int64_t> last_;  // time and number of the last row
  std::int64_t last_scanned_ = 0;
  std::optional<BagIndex> index_;
  bool is_measured_ = false;
  std::size_t damages_ = 0;
};

}  // namespace heel
