// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// ROS 1 bags.
#pragma once

#include <heel/apps/bag/bag.hpp>
#include <heel/apps/bag/chunked_bag_reader.hpp>
#include <heel/apps/bag/ros1_records.hpp>

#include <fstream>
#include <map>

namespace heel {

/// Reads a ROS 1 bag (format 2.0) by the index at its end; one whose recorder died, or which was
/// cut off or damaged there, record by record.
class Ros1BagReader final : public ChunkedBagReader {
 public:
  /// @throws std::runtime_error  if it can't be opened or is no bag of format 2.0.
  explicit Ros1BagReader(const std::filesystem::path& file);

  BagForm form() const override { return BagForm::kRos1; }

 private:
  void openChunk(const Chunk& chunk, BagBytes& unpacked, std::vector<Entry>& entries) override;
  void rewindScan() override;
  bool scanNext(BagMessage& message) override;

  bool readIndex();
  void listEntries(BagWindow window, std::uint64_t begin, const std::string& what,
                   std::vector<Entry>& entries);
  bool nextRecord();
  bool readBytes(BagBytes& bytes, std::size_t count);
  bool seekNextChunk(std::uint64_t from);
  void openScannedChunk();
  bool nextInChunk(BagMessage& message);
  bool take(const Ros1Fields& fields, const std::uint8_t* data, std::size_t size,
            BagMessage& message);
  void addConnection(const Ros1Fields& fields, const std::uint8_t* data, std::size_t size);

  std::ifstream in_;
  std::uint64_t index_at_ = 1;  // 0 until the recorder has closed the bag
  Ros1Fields fields_;
  BagBytes header_, data_, chunk_;
  std::size_t chunk_at_ = 0;
  bool chunk_is_damaged_ = false;  // and it has been told
  std::map<std::uint32_t, std::size_t> topic_of_connection_;
};

}  // namespace heel
