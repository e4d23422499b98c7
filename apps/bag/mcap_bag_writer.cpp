// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/bag/mcap_bag_writer.hpp>
#include <heel/apps/bag/ros2_folder.hpp>
#include <heel/apps/output/output.hpp>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace heel {
namespace {

constexpr std::size_t kChunkSize = 1U << 20U;

/// Schemas are counted from 1, for 0 is "none".
std::uint16_t schemaOf(std::size_t topic) { return static_cast<std::uint16_t>(topic + 1); }
std::uint16_t channelOf(std::size_t topic) { return static_cast<std::uint16_t>(topic); }

}  // namespace

void McapBagWriter::Span::add(std::int64_t ns) {
  first_ns = messages == 0 ? ns : std::min(first_ns, ns);
  last_ns = messages == 0 ? ns : std::max(last_ns, ns);
  ++messages;
}

void McapBagWriter::Span::append(McapContent& content) const {
  content.time(first_ns).time(last_ns);
}

McapBagWriter::McapBagWriter(const BagPlan& plan)
    : output_(std::make_unique<Output>(
          OutputPlan{plan.by, OutputKind::kFile, plan.path, plan.inputs, {}})),
      out_(output_->file().written, std::ios::binary | std::ios::trunc) {
  if (!out_) {
    throw OutputError(plan.path.string() + " cannot be written: " + std::strerror(errno));
  }
  BagBytes bytes(kMcapMagic.begin(), kMcapMagic.end());
  appendRecord(bytes, McapRecord::kHeader, McapContent().text("ros2").text("heel"));
  write(bytes);
}

McapBagWriter::~McapBagWriter() = default;

void McapBagWriter::write(const BagBytes& bytes) {
  out_.write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  if (!out_) throw OutputError(output_->path().string() + " cannot be written: is the disk full?");
  at_ += bytes.size();
  crc_ = mcapCrc(bytes.data(), bytes.size(), crc_);
}

void McapBagWriter::appendSchema(BagBytes& bytes, std::size_t topic) const {
  const Topic& about = topics_[topic];
  McapContent schema;
  schema.number(schemaOf(topic)).text(withMsg(about.type)).text("ros2msg").text(about.definition);
  appendRecord(bytes, McapRecord::kSchema, schema);
}

void McapBagWriter::appendChannel(BagBytes& bytes, std::size_t topic) const {
  const Topic& about = topics_[topic];
  McapContent channel, metadata;
  metadata.text("offered_qos_profiles").text(ros2Qos(about.latched));
  channel.number(channelOf(topic)).number(schemaOf(topic)).text(about.name).text("cdr");
  appendRecord(bytes, McapRecord::kChannel, channel.list(metadata));
}

void McapBagWriter::add(std::size_t topic) {
  if (topic >= std::numeric_limits<std::uint16_t>::max()) {
    throw OutputError(output_->path().string() + ": an MCAP file has no room for more topics");
  }
  appendSchema(chunk_, topic);
  appendChannel(chunk_, topic);
  counts_.push_back(0);
}

void McapBagWriter::put(std::size_t topic, std::int64_t stamp_ns,
                        const std::vector<std::uint8_t>& bytes) {
  const std::int64_t ns = std::max<std::int64_t>(stamp_ns, 0);  // its times are unsigned
  entries_[channelOf(topic)].push_back({ns, chunk_.size()});
  McapContent message;
  message.number(channelOf(topic)).number(static_cast<std::uint32_t>(counts_[topic]++));
  appendRecord(chunk_, McapRecord::kMessage, message.time(ns).time(ns).raw(bytes));
  chunk_span_.add(ns);
  span_.add(ns);
  if (chunk_.size() > kChunkSize) endChunk();
}

void McapBagWriter::endChunk() {
  if (chunk_.empty()) return;
  BagBytes packed;
  const bool is_packed = packByZstd(chunk_, packed);
  const BagBytes& stored = is_packed ? packed : chunk_;
  McapContent chunk, index, places;
  chunk_span_.append(chunk);
  chunk.number<std::uint64_t>(chunk_.size()).number(mcapCrc(chunk_.data(), chunk_.size()));
  chunk.text(is_packed ? "zstd" : "").number<std::uint64_t>(stored.size()).raw(stored);
  BagBytes record, indexes;
  appendRecord(record, McapRecord::kChunk, chunk);
  for (const auto& [channel, entries] : entries_) {
    McapContent of_channel, list;
    for (const Entry& entry : entries) list.time(entry.stamp_ns).number(entry.offset);
    places.number(channel).number<std::uint64_t>(at_ + record.size() + indexes.size());
    appendRecord(indexes, McapRecord::kMessageIndex, of_channel.number(channel).list(list));
  }
  chunk_span_.append(index);
  index.number(at_).number<std::uint64_t>(record.size()).list(places);
  index.number<std::uint64_t>(indexes.size()).text(is_packed ? "zstd" : "");
  index.number<std::uint64_t>(stored.size()).number<std::uint64_t>(chunk_.size());
  appendRecord(chunk_indexes_, McapRecord::kChunkIndex, index);
  ++chunk_count_;
  write(record);
  write(indexes);
  chunk_.clear();
  chunk_span_ = {};
  entries_.clear();
}

/// Schemas, channels, statistics and chunk indexes again, each group with its place.
void McapBagWriter::writeSummary() {
  const std::uint64_t begin = at_;
  McapContent statistics, counts;
  const auto topics = static_cast<std::uint32_t>(topics_.size());
  for (std::size_t i = 0; i < topics_.size(); ++i) counts.number(channelOf(i)).number(counts_[i]);
  statistics.number(span_.messages).number(static_cast<std::uint16_t>(topics)).number(topics);
  statistics.number(std::uint32_t{0}).number(std::uint32_t{0}).number(chunk_count_);
  span_.append(statistics);
  BagBytes schemas, channels, about;
  for (std::size_t i = 0; i < topics_.size(); ++i) appendSchema(schemas, i);
  for (std::size_t i = 0; i < topics_.size(); ++i) appendChannel(channels, i);
  appendRecord(about, McapRecord::kStatistics, statistics.list(counts));
  crc_ = 0;
  BagBytes offsets;
  const auto group = [&](McapRecord kind, const BagBytes& records) {
    if (records.empty()) return;
    McapContent offset;
    offset.number(kind).number(at_).number<std::uint64_t>(records.size());
    appendRecord(offsets, McapRecord::kSummaryOffset, offset);
    write(records);
  };
  group(McapRecord::kSchema, schemas);
  group(McapRecord::kChannel, channels);
  group(McapRecord::kStatistics, about);
  group(McapRecord::kChunkIndex, chunk_indexes_);
  const std::uint64_t offsets_at = at_;
  write(offsets);
  // The footer's own beginning belongs to what the checksum is of.
  McapContent footer;
  footer.number(begin).number(offsets_at).number(std::uint32_t{0});
  BagBytes bytes;
  appendRecord(bytes, McapRecord::kFooter, footer);
  const std::uint32_t crc = mcapCrc(bytes.data(), bytes.size() - sizeof crc_, crc_);
  std::memcpy(&bytes[bytes.size() - sizeof crc], &crc, sizeof crc);
  bytes.insert(bytes.end(), kMcapMagic.begin(), kMcapMagic.end());
  write(bytes);
}

void McapBagWriter::commit(bool complete) {
  endChunk();
  BagBytes end;
  appendRecord(end, McapRecord::kDataEnd, McapContent().number(crc_));
  write(end);
  writeSummary();
  out_.close();
  if (!out_) throw OutputError(output_->path().string() + " cannot be written: is the disk full?");
  output_->commit(complete);
}

}  // namespace heel
