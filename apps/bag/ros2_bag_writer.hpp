// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Writes ROS 2 bags in SQLite storage.
#pragma once

#include <heel/apps/bag/bag.hpp>
#include <heel/apps/bag/sqlite_file.hpp>

#include <memory>
#include <optional>

namespace heel {

class Output;

/// Writes a folder with metadata.yaml and one .db3 file, or that file alone.
class Ros2BagWriter final : public BagWriter {
 public:
  /// @throws std::invalid_argument, std::runtime_error  as createBag().
  explicit Ros2BagWriter(const BagPlan& plan);
  ~Ros2BagWriter() override;

  BagForm form() const override { return BagForm::kRos2; }
  void commit(bool complete) override;

 private:
  void add(std::size_t topic) override;
  void put(std::size_t topic, std::int64_t stamp_ns,
           const std::vector<std::uint8_t>& bytes) override;
  void writeMetadata() const;

  std::unique_ptr<Output> output_;  // before the database that is in it
  bool is_folder_;
  std::string file_name_;  // of the database in the folder
  std::optional<SqliteFile> file_;
  std::optional<SqliteQuery> insert_;
  std::vector<std::size_t> counts_;  // of messages, by topic
  std::size_t message_count_ = 0;
  std::int64_t first_ns_ = 0, last_ns_ = 0;
};

}  // namespace heel
