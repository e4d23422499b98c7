// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The messages of a ROS 2 bag whose SQLite file is damaged.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <vector>

namespace heel {

/// Looks through the pages of a database file, one after the other, for rows of the table
/// `messages`. SQLite itself finds rows through pages that may lie anywhere, mostly behind the
/// rows: of a file that was cut off it often finds none. (Format:
/// https://sqlite.org/fileformat2.html.)
class Ros2PageScan {
 public:
  struct Row {
    std::int64_t id = 0;
    std::int64_t topic_id = 0;
    std::int64_t stamp_ns = 0;
    const std::uint8_t* data = nullptr;  ///< Valid until the next row.
    std::size_t size = 0;
  };

  explicit Ros2PageScan(const std::filesystem::path& file);

  /// The next row that is whole; absent at the end.
  std::optional<Row> next();

 private:
  using Bytes = std::vector<std::uint8_t>;
  bool readPage(std::uint64_t number, Bytes& page);
  bool readCell(std::size_t offset, Row& row);
  bool addOverflow(std::uint32_t page, std::size_t size);
  bool parseRecord(Row& row) const;

  std::ifstream in_;
  std::size_t page_size_ = 0, usable_ = 0;
  std::uint64_t pages_ = 0, page_number_ = 0;
  Bytes page_, overflow_, payload_;
  std::size_t cell_ = 0, cells_ = 0;  // of this page
};

}  // namespace heel
