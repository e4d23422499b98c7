// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/bag/ros1_bag_writer.hpp>
#include <heel/apps/output/output.hpp>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace heel {
namespace {

constexpr std::size_t kChunkSize = 768U << 10U;  // as rosbag's own
/// The first record is padded, so that it can be written again when the bag is complete.
constexpr std::size_t kBagHeaderSize = 4096;

std::int64_t validTime(std::int64_t ns) {
  return std::max<std::int64_t>(ns, 1);  // rosbag takes 0 for "no time"
}

}  // namespace

Ros1BagWriter::Ros1BagWriter(const BagPlan& plan)
    : output_(std::make_unique<Output>(
          OutputPlan{plan.by, OutputKind::kFile, plan.path, plan.inputs, {}})),
      out_(output_->file().written, std::ios::binary | std::ios::trunc) {
  if (!out_) {
    throw OutputError(plan.path.string() + " cannot be written: " + std::strerror(errno));
  }
  write(BagBytes(kRos1Magic.begin(), kRos1Magic.end()));
  writeBagHeader(0);
}

Ros1BagWriter::~Ros1BagWriter() = default;

void Ros1BagWriter::write(const BagBytes& bytes) {
  out_.write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  if (!out_) throw OutputError(output_->path().string() + " cannot be written: is the disk full?");
  at_ += bytes.size();
}

void Ros1BagWriter::writeBagHeader(std::uint64_t index_at) {
  Ros1Fields fields;
  fields.set(Ros1Record::kBagHeader)
      .setLong("index_pos", index_at)
      .set("conn_count", static_cast<std::uint32_t>(topics_.size()))
      .set("chunk_count", static_cast<std::uint32_t>(chunks_.size()));
  BagBytes header;
  fields.append(header);
  BagBytes record;
  appendRecord(record, fields, BagBytes(kBagHeaderSize - header.size(), ' '));
  write(record);
}

BagBytes Ros1BagWriter::connection(std::size_t topic) const {
  const Topic& about = topics_[topic];
  Ros1Fields fields, details;
  fields.set(Ros1Record::kConnection)
      .set("conn", static_cast<std::uint32_t>(topic))
      .set("topic", about.name);
  details.set("topic", about.name)
      .set("type", about.type)
      .set("md5sum", about.md5)
      .set("message_definition", about.definition);
  if (about.latched) details.set("latching", "1").set("callerid", "/heel");
  BagBytes data, record;
  details.append(data);
  appendRecord(record, fields, data);
  return record;
}

void Ros1BagWriter::add(std::size_t topic) {
  const BagBytes record = connection(topic);
  chunk_bytes_.insert(chunk_bytes_.end(), record.begin(), record.end());
}

void Ros1BagWriter::put(std::size_t topic, std::int64_t stamp_ns,
                        const std::vector<std::uint8_t>& bytes) {
  const std::int64_t ns = validTime(stamp_ns);
  const auto connection = static_cast<std::uint32_t>(topic);
  if (chunk_.counts.empty()) chunk_.first_ns = chunk_.last_ns = ns;
  chunk_.first_ns = std::min(chunk_.first_ns, ns);
  chunk_.last_ns = std::max(chunk_.last_ns, ns);
  ++chunk_.counts[connection];
  entries_[connection].push_back({ns, static_cast<std::uint32_t>(chunk_bytes_.size())});
  Ros1Fields fields;
  fields.set(Ros1Record::kMessage).set("conn", connection).setTime("time", ns);
  appendRecord(chunk_bytes_, fields, bytes);
  if (chunk_bytes_.size() > kChunkSize) endChunk();
}

void Ros1BagWriter::endChunk() {
  if (chunk_.counts.empty()) return;
  chunk_.at = at_;
  Ros1Fields fields;
  fields.set(Ros1Record::kChunk)
      .set("compression", "none")
      .set("size", static_cast<std::uint32_t>(chunk_bytes_.size()));
  BagBytes record;
  appendRecord(record, fields, chunk_bytes_);
  for (const auto& [connection, entries] : entries_) {
    Ros1Fields index;
    index.set(Ros1Record::kIndex)
        .set("ver", std::uint32_t{1})
        .set("conn", connection)
        .set("count", static_cast<std::uint32_t>(entries.size()));
    BagBytes data;
    for (const Entry& entry : entries) {
      appendNumber(data, static_cast<std::uint32_t>(entry.stamp_ns / 1000000000));
      appendNumber(data, static_cast<std::uint32_t>(entry.stamp_ns % 1000000000));
      appendNumber(data, entry.offset);
    }
    appendRecord(record, index, data);
  }
  write(record);
  chunks_.push_back(std::move(chunk_));
  chunk_ = {};
  entries_.clear();
  chunk_bytes_.clear();
}

void Ros1BagWriter::commit(bool complete) {
  endChunk();
  const std::uint64_t index_at = at_;
  for (std::size_t i = 0; i < topics_.size(); ++i) write(connection(i));
  for (const Chunk& chunk : chunks_) {
    Ros1Fields fields;
    fields.set(Ros1Record::kChunkInfo)
        .set("ver", std::uint32_t{1})
        .setLong("chunk_pos", chunk.at)
        .setTime("start_time", chunk.first_ns)
        .setTime("end_time", chunk.last_ns)
        .set("count", static_cast<std::uint32_t>(chunk.counts.size()));
    BagBytes data, record;
    for (const auto& [connection, count] : chunk.counts) {
      appendNumber(data, connection);
      appendNumber(data, count);
    }
    appendRecord(record, fields, data);
    write(record);
  }
  out_.seekp(static_cast<std::streamoff>(kRos1Magic.size()));
  writeBagHeader(index_at);
  out_.close();
  if (!out_) throw OutputError(output_->path().string() + " cannot be written: is the disk full?");
  output_->commit(complete);
}

}  // namespace heel
