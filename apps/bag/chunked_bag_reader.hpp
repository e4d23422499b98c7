// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Bags whose messages are in chunks, with an index of these: ROS 1 and MCAP.
#pragma once

#include <heel/apps/bag/bag.hpp>
#include <heel/apps/bag/bag_file.hpp>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <queue>
#include <vector>

namespace heel {

/// Opens the chunks that have what is wanted, each when its time comes, and gives their messages in
/// the order of time. A bag without an index that holds is read from its beginning to its end.
class ChunkedBagReader : public BagReader {
 public:
  const BagIndex* index() final;
  void select(const BagQuery& query) final;
  bool next(BagMessage& message) final;

 protected:
  explicit ChunkedBagReader(const std::filesystem::path& path) : file_(path) {}

  /// A chunk as the index tells of it.
  struct Chunk {
    std::uint64_t at = 0;
    std::int64_t first_ns = 0, last_ns = 0;
    std::vector<std::size_t> topics;
  };
  /// A message in a chunk.
  struct Entry {
    std::int64_t stamp_ns = 0;
    std::size_t topic = 0;
    std::uint64_t at = 0;  ///< Among the chunk's bytes; where it is not packed, in the file.
    std::size_t size = 0;
  };

  /// Lists a chunk's messages, in any order.
  /// @param unpacked  Out: its bytes; empty if they are in the file as they are.
  virtual void openChunk(const Chunk& chunk, BagBytes& unpacked, std::vector<Entry>& entries) = 0;

  /// Without the index: begins again, and gives the next message in the file.
  virtual void rewindScan() = 0;
  virtual bool scanNext(BagMessage& message) = 0;

  /// Tells the index, when topics_ are known.
  void setIndex(std::vector<Chunk> chunks, std::vector<std::size_t> counts);
  void lose(const std::string& what);

  BagFile file_;
  std::uint64_t damages_ = 0;

 private:
  struct Open {
    std::shared_ptr<BagBytes> bytes;  ///< Null: given back, to be read again when needed.
    bool is_in_file = false;
    std::size_t left = 0;  ///< Messages to come.
  };
  struct Place {
    Entry entry;
    std::size_t chunk = 0;
    bool operator>(const Place& other) const;
  };

  /// The chunk that was opened last: often it is the first that the next query wants.
  struct Opened {
    std::size_t chunk = static_cast<std::size_t>(-1);
    std::shared_ptr<BagBytes> bytes;
    std::vector<Entry> entries;
    bool is_damaged = false;
  };

  void measure();
  const Opened& opened(std::size_t chunk);
  void open(std::size_t chunk);
  const std::uint8_t* bytesOf(const Place& place);
  void keepWithinLimit(std::size_t chunk);

  bool has_index_ = false;
  std::vector<Chunk> chunks_;  ///< By their first times.
  std::optional<BagIndex> index_;
  std::vector<std::size_t> counts_;

  Opened last_;
  std::size_t next_chunk_ = 0;
  std::map<std::size_t, Open> open_;
  std::priority_queue<Place, std::vector<Place>, std::greater<>> queue_;
  std::shared_ptr<BagBytes> given_;  ///< Holds the last message.
  BagBytes piece_;
};

}  // namespace heel
