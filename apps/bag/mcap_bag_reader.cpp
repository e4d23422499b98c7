// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/bag/mcap_bag_reader.hpp>
#include <heel/apps/bag/ros2_folder.hpp>
#include <heel/cloud/files.hpp>

#include <algorithm>
#include <stdexcept>

namespace heel {
namespace {

constexpr std::size_t kFooter = 20;

std::string byteOf(std::uint64_t at) { return "byte " + std::to_string(at); }

bool isMagic(const BagBytes& bytes) {
  return std::equal(bytes.begin(), bytes.end(), kMcapMagic.begin(), kMcapMagic.end(),
                    [](std::uint8_t a, char b) { return a == static_cast<std::uint8_t>(b); });
}

/// Takes the first record off; false if it is not whole.
bool takeRecord(McapFields& records, McapRecord& kind, McapFields& fields) {
  kind = records.number<McapRecord>();
  const auto size = records.number<std::uint64_t>();
  if (!records.ok() || size > records.left()) return false;
  fields = McapFields(records.rest(), static_cast<std::size_t>(size));
  records = McapFields(records.rest() + size, records.left() - static_cast<std::size_t>(size));
  return true;
}

}  // namespace

McapBagReader::McapBagReader(const std::filesystem::path& file) : ChunkedBagReader(file) {
  BagBytes magic;
  file_.read(0, kMcapMagic.size(), magic);
  if (!isMagic(magic)) {
    throw std::runtime_error(file_.name() +
                             ": this is no ROS bag in MCAP (it does not begin with its mark)");
  }
  Record header;
  BagBytes content;
  if (recordAt(kMcapMagic.size(), header) && header.kind == McapRecord::kHeader &&
      header.size < 4096 && file_.read(kMcapMagic.size() + kMcapRecordHead, header.size, content)) {
    const std::string_view profile = McapFields(content.data(), content.size()).text();
    knows_form_ = profile == "ros1" || profile == "ros2";
    if (profile == "ros1") form_ = BagForm::kRos1;
  }
  if (readSummary()) return;
  topics_.clear();
  types_.clear();
  topic_of_channel_.clear();
  rewindScan();
  // Which form it is, the first channel tells.
  BagMessage ignored;
  while (!knows_form_ && !at_end_) scanRecord(ignored);
  select({});
}

/// False if no record can begin there.
bool McapBagReader::recordAt(std::uint64_t at, Record& record) const {
  BagBytes head;
  if (!file_.read(at, kMcapRecordHead, head)) return false;
  McapFields fields(head.data(), head.size());
  record.kind = fields.number<McapRecord>();
  record.size = fields.number<std::uint64_t>();
  return true;
}

/// Reads a record's content as far as it is there; false if that is not all, or too much.
bool McapBagReader::readContent(std::uint64_t at, std::uint64_t size, const std::string& what) {
  content_.clear();
  const std::uint64_t begin = at + kMcapRecordHead;
  const std::uint64_t there = begin < file_.size() ? std::min(size, file_.size() - begin) : 0;
  try {
    checkMemory(what, static_cast<std::size_t>(there));
  } catch (const std::runtime_error& error) {
    lose(error.what());
    return false;
  }
  return file_.read(begin, size, content_);
}

/// Reads the summary; false if there is none that holds.
bool McapBagReader::readSummary() {
  const std::uint64_t end = kMcapRecordHead + kFooter + kMcapMagic.size();
  BagBytes magic, footer;
  if (file_.size() < kMcapMagic.size() + end) return false;
  const std::uint64_t footer_at = file_.size() - end;
  file_.read(file_.size() - kMcapMagic.size(), kMcapMagic.size(), magic);
  file_.read(footer_at, kMcapRecordHead + kFooter, footer);
  McapFields fields(footer.data(), footer.size());
  if (!isMagic(magic) || fields.number<McapRecord>() != McapRecord::kFooter ||
      fields.number<std::uint64_t>() != kFooter) {
    return false;
  }
  const auto begin = fields.number<std::uint64_t>();
  fields.number<std::uint64_t>();  // where the groups' places are
  const auto crc = fields.number<std::uint32_t>();
  if (begin < kMcapMagic.size() || begin >= footer_at) return false;
  BagBytes summary;
  try {
    checkMemory(file_.name() + ": its summary", footer_at - begin, file_.size());
  } catch (const std::runtime_error&) {
    return false;
  }
  if (!file_.read(begin, footer_at - begin, summary)) return false;
  const std::uint32_t sum = mcapCrc(summary.data(), summary.size());
  if (crc != 0 && crc != mcapCrc(footer.data(), footer.size() - sizeof crc, sum)) return false;
  return readIndex(McapFields(summary.data(), summary.size()));
}

bool McapBagReader::readIndex(McapFields summary) {
  std::vector<Chunk> chunks;
  std::vector<std::vector<std::uint16_t>> channels_of_chunk;
  std::map<std::uint16_t, std::uint64_t> counts;
  std::uint64_t messages = 0, chunk_count = 0;
  bool has_statistics = false;
  McapRecord kind{};
  McapFields fields(nullptr, 0);
  while (summary.left() > 0) {
    if (!takeRecord(summary, kind, fields)) return false;
    if (kind == McapRecord::kSchema) addSchema(fields);
    if (kind == McapRecord::kChannel) addChannel(fields);
    if (kind == McapRecord::kChunkIndex) {
      Chunk chunk;
      chunk.first_ns = fields.time();
      chunk.last_ns = fields.time();
      chunk.at = fields.number<std::uint64_t>();
      fields.number<std::uint64_t>();
      McapFields places = fields.list();
      std::vector<std::uint16_t> channels;
      while (places.left() > 0 && places.ok()) {
        channels.push_back(places.number<std::uint16_t>());
        places.number<std::uint64_t>();
      }
      if (!fields.ok() || chunk.at >= file_.size()) return false;
      chunks.push_back(chunk);
      channels_of_chunk.push_back(channels);
    } else if (kind == McapRecord::kStatistics) {
      messages = fields.number<std::uint64_t>();
      fields.number<std::uint16_t>();
      for (int i = 0; i < 3; ++i) fields.number<std::uint32_t>();
      chunk_count = fields.number<std::uint32_t>();
      fields.time();
      fields.time();
      McapFields list = fields.list();
      while (list.left() > 0 && list.ok()) {
        const auto channel = list.number<std::uint16_t>();
        counts[channel] = list.number<std::uint64_t>();
      }
      has_statistics = fields.ok();
    }
  }
  // Messages may also lie outside of chunks: of these there is no index.
  if (!has_statistics || chunk_count != chunks.size() || (messages > 0 && chunks.empty())) {
    return false;
  }
  std::vector<std::size_t> counts_of_topics(topics_.size(), 0);
  for (const auto& [channel, count] : counts) {
    const auto topic = topic_of_channel_.find(channel);
    if (topic != topic_of_channel_.end()) counts_of_topics[topic->second] += count;
  }
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    for (const std::uint16_t channel : channels_of_chunk[i]) {
      const auto topic = topic_of_channel_.find(channel);
      if (topic != topic_of_channel_.end()) chunks[i].topics.push_back(topic->second);
    }
    // A writer may leave out the messages' index: then any of them may be in it.
    if (channels_of_chunk[i].empty()) {
      for (std::size_t topic = 0; topic < topics_.size(); ++topic)
        chunks[i].topics.push_back(topic);
    }
  }
  if (messages > 0 && topics_.empty() && counts.empty()) return false;
  setIndex(std::move(chunks), std::move(counts_of_topics));
  return true;
}

void McapBagReader::addSchema(McapFields fields) {
  const auto id = fields.number<std::uint16_t>();
  const std::string_view name = fields.text();
  if (fields.ok()) types_.insert({id, withoutMsg(printable(name))});
}

/// Channels of other forms than ours, JSON for instance, are left out.
void McapBagReader::addChannel(McapFields fields) {
  const auto id = fields.number<std::uint16_t>();
  const auto schema = fields.number<std::uint16_t>();
  BagTopic topic;
  topic.name = printable(fields.text());
  const std::string_view encoding = fields.text();
  McapFields metadata = fields.list();
  if (!fields.ok() || (encoding != "cdr" && encoding != "ros1")) return;
  const BagForm form = encoding == "ros1" ? BagForm::kRos1 : BagForm::kRos2;
  if (!knows_form_) form_ = form;
  knows_form_ = true;
  if (form != form_ || topic_of_channel_.count(id) > 0) return;
  if (const auto type = types_.find(schema); type != types_.end()) topic.type = type->second;
  while (metadata.left() > 0 && metadata.ok()) {
    const std::string_view key = metadata.text(), value = metadata.text();
    if (key == "md5sum" && form == BagForm::kRos1) topic.md5 = printable(value);
  }
  const auto same = std::find_if(topics_.begin(), topics_.end(), [&](const BagTopic& known) {
    return known.name == topic.name && known.type == topic.type && known.md5 == topic.md5;
  });
  topic_of_channel_[id] = static_cast<std::size_t>(same - topics_.begin());
  if (same == topics_.end()) topics_.push_back(topic);
}

/// Takes a schema, a channel or a message; true if it is a message.
bool McapBagReader::take(McapRecord kind, McapFields fields, BagMessage& message) {
  if (kind == McapRecord::kSchema) addSchema(fields);
  if (kind == McapRecord::kChannel) addChannel(fields);
  if (kind != McapRecord::kMessage) return false;
  const auto topic = topic_of_channel_.find(fields.number<std::uint16_t>());
  fields.number<std::uint32_t>();
  message.stamp_ns = fields.time();
  fields.time();
  if (!fields.ok() || topic == topic_of_channel_.end()) return false;
  message.topic = topic->second;
  message.data = fields.rest();
  message.size = fields.left();
  return true;
}

/// Unpacks a chunk whose record's content begins at `at`, as far as that goes.
bool McapBagReader::unpack(McapFields fields, std::uint64_t at, bool is_whole, BagBytes& unpacked) {
  fields.time();
  fields.time();
  const auto size = fields.number<std::uint64_t>();
  const auto crc = fields.number<std::uint32_t>();
  const std::string packing(fields.text());
  const auto packed_size = fields.number<std::uint64_t>();
  unpacked.clear();
  const std::string what = "the chunk at " + byteOf(at);
  if (!fields.ok() || (is_whole && packed_size != fields.left())) {
    if (is_whole) lose(what + " is damaged");
    return false;
  }
  if (!isKnownPacking(packing)) {
    lose(what + " is packed by '" + printable(packing) + "', which is unknown");
    return false;
  }
  try {
    checkMemory(what, static_cast<std::size_t>(size), fields.left());
  } catch (const std::runtime_error& error) {
    lose(error.what());
    return false;
  }
  const bool is_unpacked =
      unpackChunk(packing, fields.rest(), fields.left(), static_cast<std::size_t>(size), unpacked);
  if (!is_whole) return true;
  const bool is_right =
      is_unpacked && (crc == 0 || crc == mcapCrc(unpacked.data(), unpacked.size()));
  if (is_right) return true;
  // Where it is wrong is not known, so that none of its messages can be trusted.
  lose(what + " is damaged");
  unpacked.clear();
  return false;
}

void McapBagReader::openChunk(const Chunk& chunk, BagBytes& unpacked, std::vector<Entry>& entries) {
  const std::string what = "the chunk at " + byteOf(chunk.at);
  Record record;
  if (!recordAt(chunk.at, record) || record.kind != McapRecord::kChunk ||
      !readContent(chunk.at, record.size, what)) {
    return lose(what + " is damaged");
  }
  if (!unpack(McapFields(content_.data(), content_.size()), chunk.at, true, unpacked)) return;
  McapFields records(unpacked.data(), unpacked.size());
  McapRecord kind{};
  McapFields fields(nullptr, 0);
  BagMessage message;
  while (records.left() > 0) {
    if (!takeRecord(records, kind, fields)) return lose(what + " is damaged");
    // All channels are known by the summary: one that is not has no place in the index.
    if (kind != McapRecord::kMessage || !take(kind, fields, message)) continue;
    entries.push_back({message.stamp_ns, message.topic,
                       static_cast<std::uint64_t>(message.data - unpacked.data()), message.size});
  }
}

void McapBagReader::rewindScan() {
  at_ = kMcapMagic.size();
  at_end_ = is_closed_ = false;
  chunk_.clear();
  chunk_at_ = 0;
}

bool McapBagReader::nextInChunk(BagMessage& message) {
  McapFields records(chunk_.data() + chunk_at_, chunk_.size() - chunk_at_);
  McapRecord kind{};
  McapFields fields(nullptr, 0);
  while (records.left() > 0) {
    // What was cut off has been told; there is no way to find the next one in what is damaged.
    const bool is_whole = takeRecord(records, kind, fields);
    chunk_at_ = chunk_.size() - (is_whole ? records.left() : 0);
    if (!is_whole) return false;
    if (take(kind, fields, message)) return true;
  }
  return false;
}

bool McapBagReader::scanNext(BagMessage& message) {
  while (true) {
    if (nextInChunk(message)) return true;
    if (at_end_) return false;
    if (scanRecord(message)) return true;
  }
}

/// Takes the next record in the file; true if it is a message.
bool McapBagReader::scanRecord(BagMessage& message) {
  const std::uint64_t begin = at_;
  Record record;
  const bool is_whole =
      recordAt(begin, record) && record.size <= file_.size() - begin - kMcapRecordHead;
  const bool is_cut = !is_whole && !is_closed_;
  at_end_ = !is_whole || record.kind == McapRecord::kFooter;
  if (is_cut) {
    if (begin >= file_.size()) {
      lost_ = file_.name() + ": the bag was not closed by its recorder; all that is there was read";
    } else {
      lose("the bag is cut off or damaged at " + byteOf(begin));
    }
  }
  is_closed_ = is_closed_ || record.kind == McapRecord::kDataEnd;
  if (at_end_ && (!is_cut || record.kind != McapRecord::kChunk)) return false;
  at_ = begin + kMcapRecordHead + record.size;
  const bool is_ours = record.kind == McapRecord::kSchema || record.kind == McapRecord::kChannel ||
                       record.kind == McapRecord::kMessage || record.kind == McapRecord::kChunk;
  // Behind the data are the summary's repetitions.
  if (!is_ours || is_closed_) return false;
  const bool is_read = readContent(begin, record.size, "a record at " + byteOf(begin));
  if (!is_read && is_whole) return false;
  const McapFields fields(content_.data(), content_.size());
  if (record.kind != McapRecord::kChunk) return take(record.kind, fields, message);
  chunk_at_ = 0;
  unpack(fields, begin, is_whole, chunk_);
  // A form that is not known yet is in the first channel of the first chunk.
  return nextInChunk(message);
}

}  // namespace heel
