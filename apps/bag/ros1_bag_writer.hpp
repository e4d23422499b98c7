// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Writes ROS 1 bags, with their index.
#pragma once

#include <heel/apps/bag/bag.hpp>
#include <heel/apps/bag/ros1_records.hpp>

#include <fstream>
#include <map>
#include <memory>

namespace heel {

class Output;

/// Writes a bag of format 2.0 in chunks that are not packed: what is large, pictures, is already.
class Ros1BagWriter final : public BagWriter {
 public:
  /// @throws std::invalid_argument, std::runtime_error  as createBag().
  explicit Ros1BagWriter(const BagPlan& plan);
  ~Ros1BagWriter() override;

  BagForm form() const override { return BagForm::kRos1; }
  void commit(bool complete) override;

 private:
  void add(std::size_t topic) override;
  void put(std::size_t topic, std::int64_t stamp_ns,
           const std::vector<std::uint8_t>& bytes) override;
  void writeBagHeader(std::uint64_t index_at);
  void endChunk();
  void write(const BagBytes& bytes);
  BagBytes connection(std::size_t topic) const;

  /// Where a message is in its chunk.
  struct Entry {
    std::int64_t stamp_ns;
    std::uint32_t offset;
  };
  /// What the index says of a chunk.
  struct Chunk {
    std::uint64_t at = 0;
    std::int64_t first_ns = 0, last_ns = 0;
    std::map<std::uint32_t, std::uint32_t> counts;  // of messages, by connection
  };

  std::unique_ptr<Output> output_;
  std::ofstream out_;
  std::uint64_t at_ = 0;
  BagBytes chunk_bytes_;
  Chunk chunk_;
  std::map<std::uint32_t, std::vector<Entry>> entries_;  // of this chunk, by connection
  std::vector<Chunk> chunks_;                            // done
};

}  // namespace heel
