// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Reads MCAP files.
#pragma once

#include <heel/apps/bag/chunked_bag_reader.hpp>
#include <heel/apps/bag/mcap_records.hpp>

#include <map>
#include <string>

namespace heel {

/// Reads messages in CDR or in ROS 1's form, whichever the file has first, by the summary at its
/// end; without it, record by record up to where the file was cut off.
class McapBagReader final : public ChunkedBagReader {
 public:
  /// @throws std::runtime_error  if it can't be opened or is no MCAP file.
  explicit McapBagReader(const std::filesystem::path& file);

  BagForm form() const override { return form_; }

 private:
  void openChunk(const Chunk& chunk, BagBytes& unpacked, std::vector<Entry>& entries) override;
  void rewindScan() override;
  bool scanNext(BagMessage& message) override;

  struct Record {
    McapRecord kind = McapRecord::kHeader;
    std::uint64_t size = 0;
  };
  bool recordAt(std::uint64_t at, Record& record) const;
  bool readContent(std::uint64_t at, std::uint64_t size, const std::string& what);
  bool readSummary();
  bool readIndex(McapFields summary);
  bool scanRecord(BagMessage& message);
  bool unpack(McapFields fields, std::uint64_t at, bool is_whole, BagBytes& unpacked);
  bool nextInChunk(BagMessage& message);
  bool take(McapRecord kind, McapFields fields, BagMessage& message);
  void addSchema(McapFields fields);
  void addChannel(McapFields fields);

  BagForm form_ = BagForm::kRos2;
  bool knows_form_ = false;
  std::map<std::uint16_t, std::string> types_;  // by schema
  std::map<std::uint16_t, std::size_t> topic_of_channel_;
  std::uint64_t at_ = 0;  // of the scan
  bool at_end_ = false, is_closed_ = false;
  BagBytes content_, chunk_;
  std::size_t chunk_at_ = 0;
};

}  // namespace heel
