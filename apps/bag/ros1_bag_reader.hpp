// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// ROS 1 bags, read record by record.
#pragma once

#include <heel/apps/bag/bag.hpp>
#include <heel/apps/bag/ros1_records.hpp>

#include <fstream>
#include <map>

namespace heel {

/// Walks the records of a ROS 1 bag (format 2.0) and does without its index, so that bags whose
/// recorder died, or which were cut off or damaged, are read on the same way as whole ones.
class Ros1BagReader final : public BagReader {
 public:
  /// @throws std::runtime_error  if it can't be opened or is no bag of format 2.0.
  explicit Ros1BagReader(const std::filesystem::path& file);

  BagForm form() const override { return BagForm::kRos1; }
  bool next(BagMessage& message) override;

 private:
  bool nextRecord();
  bool readBytes(Ros1Bytes& bytes, std::size_t count);
  bool seekNextChunk(std::uint64_t from);
  void openChunk();
  std::size_t recordInChunk();
  bool nextInChunk(BagMessage& message);
  bool take(const Ros1Fields& fields, const std::uint8_t* data, std::size_t size,
            BagMessage& message);
  void addConnection(const Ros1Fields& fields, const std::uint8_t* data, std::size_t size);
  void lose(const std::string& what);

  std::string name_;
  std::ifstream in_;
  std::uint64_t file_size_ = 0;
  std::uint64_t index_at_ = 1;  // 0 until the recorder has closed the bag
  std::uint64_t damages_ = 0;
  Ros1Fields fields_, inner_;
  Ros1Bytes header_, data_, chunk_;
  std::size_t chunk_at_ = 0;
  bool chunk_is_damaged_ = false;  // and it has been told
  std::map<std::uint32_t, std::size_t> topic_of_connection_;
};

}  // namespace heel
