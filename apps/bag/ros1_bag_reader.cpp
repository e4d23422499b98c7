// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/bag/chunk_packing.hpp>
#include <heel/apps/bag/ros1_bag_reader.hpp>
#include <heel/cloud/files.hpp>

#include <algorithm>
#include <stdexcept>

namespace heel {
namespace {

/// The header of a record is a few hundred bytes; of a connection, some kilobytes in its data.
constexpr std::uint32_t kLongestHeader = 1U << 20U;
/// What the index tells of a connection or of a chunk.
constexpr std::uint64_t kLongestEntry = 64U << 20U;

struct Record {
  Ros1Fields fields;
  std::uint64_t data_at = 0, data_size = 0;
  std::uint64_t end() const { return data_at + data_size; }
};

/// False if no whole record begins there.
bool recordAt(BagWindow& window, std::uint64_t at, Record& record) {
  constexpr std::uint64_t kLeastHeader = 8;  // the field "op=.": seen soon, where all is 0
  const std::uint8_t* length = window.at(at, 4);
  const std::uint64_t header = length == nullptr ? 0 : numberAt(length);
  if (header < kLeastHeader || header > kLongestHeader) return false;
  const std::uint8_t* bytes = window.at(at + 4, header + 4);
  if (bytes == nullptr) return false;
  record.data_at = at + 8 + header;
  record.data_size = numberAt(bytes + header);
  return record.data_size <= window.size() - record.data_at &&
         record.fields.parse(bytes, static_cast<std::size_t>(header)) && record.fields.kind();
}

}  // namespace

Ros1BagReader::Ros1BagReader(const std::filesystem::path& file) : ChunkedBagReader(file) {
  in_.open(file, std::ios::binary);
  if (!in_) throw std::runtime_error(file_.name() + ": can't be opened");
  std::string magic(kRos1Magic.size(), '\0');
  in_.read(magic.data(), static_cast<std::streamsize>(magic.size()));
  if (magic.rfind("#ROSBAG V1", 0) == 0) {
    throw std::runtime_error(file_.name() +
                             ": the bag is of the old format 1; 'rosbag fix' converts it");
  }
  if (magic != kRos1Magic) {
    throw std::runtime_error(file_.name() +
                             ": this is no ROS 1 bag (it does not begin with '#ROSBAG')");
  }
  if (readIndex()) return;
  topics_.clear();
  topic_of_connection_.clear();
  rewindScan();
}

/// Reads the connections and chunks that are listed behind the last chunk; false if it does not all
/// hold.
bool Ros1BagReader::readIndex() {
  BagWindow file(file_, 0, file_.size());
  Record record;
  const Ros1Fields& fields = record.fields;
  if (!recordAt(file, kRos1Magic.size(), record) || fields.kind() != Ros1Record::kBagHeader) {
    return false;
  }
  const auto index_at = fields.longNumber("index_pos");
  const auto chunk_count = fields.number("chunk_count");
  if (!index_at || !chunk_count || *index_at < kRos1Magic.size()) return false;
  std::vector<Chunk> chunks;
  std::vector<std::size_t> counts;
  for (std::uint64_t at = *index_at; at < file_.size(); at = record.end()) {
    if (!recordAt(file, at, record) || record.data_size > kLongestEntry) return false;
    const std::uint8_t* data = file.at(record.data_at, record.data_size);
    if (data == nullptr) return false;
    if (fields.kind() == Ros1Record::kConnection) {
      addConnection(fields, data, static_cast<std::size_t>(record.data_size));
      counts.resize(topics_.size());
      continue;
    }
    const auto chunk_at = fields.longNumber("chunk_pos");
    const auto first_ns = fields.time("start_time"), last_ns = fields.time("end_time");
    if (fields.kind() != Ros1Record::kChunkInfo || !chunk_at || !first_ns || !last_ns) return false;
    Chunk chunk{*chunk_at, *first_ns, *last_ns, {}};
    for (std::uint64_t i = 0; i + 8 <= record.data_size; i += 8) {
      const auto topic = topic_of_connection_.find(numberAt(data + i));
      if (topic == topic_of_connection_.end()) return false;
      chunk.topics.push_back(topic->second);
      counts[topic->second] += numberAt(data + i + 4);
    }
    chunks.push_back(std::move(chunk));
  }
  if (chunks.size() != *chunk_count || *index_at >= file_.size()) return false;
  setIndex(std::move(chunks), std::move(counts));
  return true;
}

void Ros1BagReader::openChunk(const Chunk& chunk, BagBytes& unpacked, std::vector<Entry>& entries) {
  BagWindow file(file_, 0, file_.size());
  const std::string what = "the chunk at byte " + std::to_string(chunk.at);
  Record record;
  if (!recordAt(file, chunk.at, record) || record.fields.kind() != Ros1Record::kChunk) {
    return lose(what + " is damaged");
  }
  const auto size = record.fields.number("size");
  const auto compression = record.fields.text("compression");
  if (!size || !compression) return lose(what + " is damaged");
  if (*compression == "none") {
    // Of what is not wanted, no more is read than how long it is.
    return listEntries(BagWindow(file_, record.data_at, record.data_size), record.data_at, what,
                       entries);
  }
  if (!isKnownPacking(*compression)) {
    return lose(what + " is packed by '" + printable(*compression) + "', which is unknown");
  }
  try {
    checkMemory(what, *size, static_cast<std::size_t>(record.data_size));
  } catch (const std::runtime_error& error) {
    return lose(error.what());
  }
  BagBytes packed;
  file_.read(record.data_at, record.data_size, packed);
  if (!unpackChunk(*compression, packed.data(), packed.size(), *size, unpacked))
    lose(what + " is damaged");
  if (!unpacked.empty()) listEntries(BagWindow(unpacked), 0, what, entries);
}

/// Lists the messages of a chunk whose bytes begin at `begin`.
void Ros1BagReader::listEntries(BagWindow window, std::uint64_t begin, const std::string& what,
                                std::vector<Entry>& entries) {
  Record record;
  bool is_told = false;
  for (std::uint64_t at = 0; at < window.size();) {
    if (!recordAt(window, at, record)) {
      if (!is_told) lose(what + " is damaged");
      is_told = true;
      ++at;  // to where a record begins again
      continue;
    }
    at = record.end();
    const auto connection = record.fields.number("conn");
    const auto time = record.fields.time("time");
    const auto topic = topic_of_connection_.find(connection.value_or(0));
    if (record.fields.kind() == Ros1Record::kMessage && connection && time &&
        topic != topic_of_connection_.end()) {
      entries.push_back({*time, topic->second, begin + record.data_at,
                         static_cast<std::size_t>(record.data_size)});
    }
  }
}

void Ros1BagReader::rewindScan() {
  in_.clear();
  in_.seekg(static_cast<std::streamoff>(kRos1Magic.size()));
  chunk_.clear();
  chunk_at_ = 0;
}

bool Ros1BagReader::readBytes(BagBytes& bytes, std::size_t count) {
  const auto at = static_cast<std::uint64_t>(in_.tellg());
  bytes.resize(static_cast<std::size_t>(std::min<std::uint64_t>(count, file_.size() - at)));
  in_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  return in_.good() && bytes.size() == count;
}

/// Goes on where the next chunk seems to begin, if there is one.
bool Ros1BagReader::seekNextChunk(std::uint64_t from) {
  constexpr std::size_t kPiece = 1U << 20U;
  const std::string wanted = "compression=";
  std::string piece;
  for (std::uint64_t at = from; at + 32 < file_.size(); at += kPiece - 64) {
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(at));
    piece.resize(static_cast<std::size_t>(std::min<std::uint64_t>(kPiece, file_.size() - at)));
    in_.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    for (auto hit = piece.find(wanted); hit != std::string::npos;
         hit = piece.find(wanted, hit + 1)) {
      // Before it are the lengths of the header and of this field, and maybe the field "op=.".
      for (const std::size_t before : {std::size_t{8}, std::size_t{16}}) {
        if (hit < before) continue;
        const auto* start = reinterpret_cast<const std::uint8_t*>(piece.data()) + hit - before;
        const std::uint32_t length = numberAt(start);
        if (length > 100 || hit - before + 4 + length > piece.size()) continue;
        if (!fields_.parse(start + 4, length) || fields_.kind() != Ros1Record::kChunk) continue;
        in_.clear();
        in_.seekg(static_cast<std::streamoff>(at + hit - before));
        return true;
      }
    }
  }
  return false;
}

/// Reads the next record into fields_ and data_; false at the end.
bool Ros1BagReader::nextRecord() {
  while (true) {
    const auto begin = static_cast<std::uint64_t>(in_.tellg());
    if (begin >= file_.size()) return false;
    BagBytes number;
    const auto readLength = [&](std::uint32_t& length) {
      if (!readBytes(number, 4)) return false;
      length = numberAt(number.data());
      return true;
    };
    std::uint32_t header_length = 0, data_length = 0;
    const bool has_header = readLength(header_length) && header_length <= kLongestHeader &&
                            readBytes(header_, header_length) &&
                            fields_.parse(header_.data(), header_.size()) && fields_.kind() &&
                            readLength(data_length);
    if (has_header && readBytes(data_, data_length)) return true;
    const bool cut_off = in_.eof() || static_cast<std::uint64_t>(in_.tellg()) >= file_.size();
    // The rest of a chunk that was cut off still has messages in it.
    const bool is_chunk = has_header && fields_.kind() == Ros1Record::kChunk;
    in_.clear();
    if (seekNextChunk(begin + 4)) {
      lose("the bag is damaged at byte " + std::to_string(begin));
      continue;
    }
    in_.seekg(0, std::ios::end);
    if (is_chunk) {
      // seekNextChunk has overwritten the fields.
      fields_.parse(header_.data(), header_.size());
      return true;
    }
    lose((cut_off ? "the bag is cut off at byte " : "the bag is damaged from byte ") +
         std::to_string(begin) + " on");
    return false;
  }
}

void Ros1BagReader::addConnection(const Ros1Fields& fields, const std::uint8_t* data,
                                  std::size_t size) {
  const auto number = fields.number("conn");
  const auto topic = fields.text("topic");
  Ros1Fields about;
  if (!number || !topic || !about.parse(data, size)) return;
  if (topic_of_connection_.count(*number) > 0) return;
  const std::string name = printable(*topic), type = printable(about.text("type").value_or(""));
  const std::string md5(about.text("md5sum").value_or(""));
  // Every publisher of a topic has a connection of its own.
  const auto same = std::find_if(topics_.begin(), topics_.end(), [&](const BagTopic& known) {
    return known.name == name && known.type == type && known.md5 == md5;
  });
  topic_of_connection_[*number] = static_cast<std::size_t>(same - topics_.begin());
  if (same == topics_.end()) topics_.push_back({name, type, md5});
}

/// Takes a connection or a message; true if it is a message.
bool Ros1BagReader::take(const Ros1Fields& fields, const std::uint8_t* data, std::size_t size,
                         BagMessage& message) {
  if (fields.kind() == Ros1Record::kConnection) addConnection(fields, data, size);
  if (fields.kind() != Ros1Record::kMessage) return false;
  const auto connection = fields.number("conn");
  const auto time = fields.time("time");
  if (!connection || !time) return false;
  const auto topic = topic_of_connection_.find(*connection);
  if (topic == topic_of_connection_.end()) return false;
  message = {topic->second, *time, data, size};
  return true;
}

void Ros1BagReader::openScannedChunk() {
  const auto size = fields_.number("size");
  const auto compression = fields_.text("compression");
  chunk_at_ = 0;
  chunk_is_damaged_ = false;
  chunk_.clear();
  const auto at = std::to_string(static_cast<std::uint64_t>(in_.tellg()));
  if (!size || !compression) return lose("a chunk that ends at byte " + at + " has no size");
  if (!isKnownPacking(*compression)) {
    return lose("a chunk is packed by '" + std::string(*compression) + "', which is unknown");
  }
  try {
    checkMemory("a chunk that ends at byte " + at, *size, data_.size());
  } catch (const std::runtime_error& error) {
    return lose(error.what());
  }
  if (unpackChunk(*compression, data_.data(), data_.size(), *size, chunk_)) return;
  chunk_is_damaged_ = true;
  const bool is_last = static_cast<std::uint64_t>(in_.tellg()) >= file_.size();
  lose(is_last ? "the bag is cut off at byte " + at
               : "the chunk that ends at byte " + at + " is damaged");
}

bool Ros1BagReader::nextInChunk(BagMessage& message) {
  BagWindow window(chunk_);
  Record record;
  while (chunk_at_ < chunk_.size()) {
    if (!recordAt(window, chunk_at_, record)) {
      if (!chunk_is_damaged_) lose("a chunk of the bag is damaged");
      chunk_is_damaged_ = true;
      ++chunk_at_;  // to where a record begins again
      continue;
    }
    chunk_at_ = static_cast<std::size_t>(record.end());
    if (take(record.fields, chunk_.data() + record.data_at,
             static_cast<std::size_t>(record.data_size), message)) {
      return true;
    }
  }
  chunk_.clear();
  return false;
}

bool Ros1BagReader::scanNext(BagMessage& message) {
  while (true) {
    if (nextInChunk(message)) return true;
    if (!nextRecord()) {
      if (index_at_ == 0 && lost_.empty()) {
        lost_ =
            file_.name() + ": the bag was not closed by its recorder; all that is there was read";
      }
      if (index_at_ > file_.size() && lost_.empty()) {
        lose("the bag is cut off at byte " + std::to_string(file_.size()));
      }
      return false;
    }
    if (fields_.kind() == Ros1Record::kBagHeader) {
      index_at_ = fields_.longNumber("index_pos").value_or(0);
    } else if (fields_.kind() == Ros1Record::kChunk) {
      openScannedChunk();
    } else if (take(fields_, data_.data(), data_.size(), message)) {
      return true;
    }
  }
}

}  // namespace heel
