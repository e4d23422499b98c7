// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Writes MCAP files.
#pragma once

#include <heel/apps/bag/bag.hpp>
#include <heel/apps/bag/mcap_records.hpp>

#include <fstream>
#include <map>
#include <memory>

namespace heel {

class Output;

/// Writes a file as `ros2 bag record` does: messages in CDR, in chunks that are packed by zstd
/// where that makes them smaller, with definitions, indexes, statistics and checksums.
class McapBagWriter final : public BagWriter {
 public:
  /// @throws std::invalid_argument, std::runtime_error  as createBag().
  explicit McapBagWriter(const BagPlan& plan);
  ~McapBagWriter() override;

  BagForm form() const override { return BagForm::kRos2; }
  void commit(bool complete) override;

 private:
  void add(std::size_t topic) override;
  void put(std::size_t topic, std::int64_t stamp_ns,
           const std::vector<std::uint8_t>& bytes) override;
  void appendSchema(BagBytes& bytes, std::size_t topic) const;
  void appendChannel(BagBytes& bytes, std::size_t topic) const;
  void endChunk();
  void writeSummary();
  void write(const BagBytes& bytes);

  struct Span {
    std::int64_t first_ns = 0, last_ns = 0;
    std::uint64_t messages = 0;
    void add(std::int64_t ns);
    void append(McapContent& content) const;
  };
  /// Where a message is in its chunk.
  struct Entry {
    std::int64_t stamp_ns;
    std::uint64_t offset;
  };

  std::unique_ptr<Output> output_;
  std::ofstream out_;
  std::uint64_t at_ = 0;
  std::uint32_t crc_ = 0;  // of all that was written
  BagBytes chunk_;
  Span chunk_span_, span_;
  std::map<std::uint16_t, std::vector<Entry>> entries_;  // of this chunk, by channel
  std::vector<std::uint64_t> counts_;                    // of messages, by topic
  BagBytes chunk_indexes_;
  std::uint32_t chunk_count_ = 0;
};

}  // namespace heel
