// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/bag/ros1_bag_reader.hpp>
#include <heel/cloud/file_limits.hpp>

#include <algorithm>
#include <stdexcept>

namespace heel {
namespace {

/// The header of a record is a few hundred bytes; of a connection, some kilobytes in its data.
constexpr std::uint32_t kLongestHeader = 1U << 20U;

}  // namespace

Ros1BagReader::Ros1BagReader(const std::filesystem::path& file) : name_(file.string()) {
  checkIsFile(file);
  in_.open(file, std::ios::binary);
  if (!in_) throw std::runtime_error(name_ + ": can't be opened");
  std::error_code problem;
  file_size_ = std::filesystem::file_size(file, problem);
  if (problem) throw std::runtime_error(name_ + ": " + problem.message());
  if (file_size_ == 0) throw std::runtime_error(name_ + ": the bag is empty (0 bytes)");
  std::string magic(kRos1Magic.size(), '\0');
  in_.read(magic.data(), static_cast<std::streamsize>(magic.size()));
  if (magic.rfind("#ROSBAG V1", 0) == 0) {
    throw std::runtime_error(name_ + ": the bag is of the old format 1; 'rosbag fix' converts it");
  }
  if (magic != kRos1Magic) {
    throw std::runtime_error(name_ + ": this is no ROS 1 bag (it does not begin with '#ROSBAG')");
  }
}

void Ros1BagReader::lose(const std::string& what) {
  ++damages_;
  lost_ = name_ + ": " + what + "; what else is there was read";
  if (damages_ > 1) {
    lost_ = name_ + ": the bag is damaged at " + std::to_string(damages_) +
            " places; what else is there was read";
  }
}

bool Ros1BagReader::readBytes(Ros1Bytes& bytes, std::size_t count) {
  const auto at = static_cast<std::uint64_t>(in_.tellg());
  bytes.resize(static_cast<std::size_t>(std::min<std::uint64_t>(count, file_size_ - at)));
  in_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  return in_.good() && bytes.size() == count;
}

/// Goes on where the next chunk seems to begin, if there is one.
bool Ros1BagReader::seekNextChunk(std::uint64_t from) {
  constexpr std::size_t kPiece = 1U << 20U;
  const std::string wanted = "compression=";
  std::string piece;
  for (std::uint64_t at = from; at + 32 < file_size_; at += kPiece - 64) {
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(at));
    piece.resize(static_cast<std::size_t>(std::min<std::uint64_t>(kPiece, file_size_ - at)));
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
    if (begin >= file_size_) return false;
    Ros1Bytes number;
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
    const bool cut_off = in_.eof() || static_cast<std::uint64_t>(in_.tellg()) >= file_size_;
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

void Ros1BagReader::openChunk() {
  const auto size = fields_.number("size");
  const auto compression = fields_.text("compression");
  chunk_at_ = 0;
  chunk_is_damaged_ = false;
  chunk_.clear();
  const auto at = std::to_string(static_cast<std::uint64_t>(in_.tellg()));
  if (!size || !compression) return lose("a chunk that ends at byte " + at + " has no size");
  if (*compression != "none" && *compression != "bz2" && *compression != "lz4") {
    return lose("a chunk is packed by '" + std::string(*compression) + "', which is unknown");
  }
  try {
    checkMemory("a chunk that ends at byte " + at, *size, data_.size());
  } catch (const std::runtime_error& error) {
    return lose(error.what());
  }
  if (unpackChunk(*compression, data_, *size, chunk_)) return;
  chunk_is_damaged_ = true;
  const bool is_last = static_cast<std::uint64_t>(in_.tellg()) >= file_size_;
  lose(is_last ? "the bag is cut off at byte " + at
               : "the chunk that ends at byte " + at + " is damaged");
}

/// The size of the record that begins at chunk_at_, whose fields are then in inner_; 0 if there is
/// none.
std::size_t Ros1BagReader::recordInChunk() {
  const std::uint8_t* at = chunk_.data() + chunk_at_;
  const std::size_t left = chunk_.size() - chunk_at_;
  constexpr std::size_t kLeastHeader = 8;  // the field "op=.": seen soon, where all is 0
  if (left < 8 || numberAt(at) < kLeastHeader || numberAt(at) > left - 8) return 0;
  const std::size_t header = numberAt(at), data = numberAt(at + 4 + header);
  if (data > left - 8 - header || !inner_.parse(at + 4, header) || !inner_.kind()) return 0;
  return 8 + header + data;
}

bool Ros1BagReader::nextInChunk(BagMessage& message) {
  while (chunk_at_ < chunk_.size()) {
    const std::size_t size = recordInChunk();
    if (size == 0) {
      if (!chunk_is_damaged_) lose("a chunk of the bag is damaged");
      chunk_is_damaged_ = true;
      ++chunk_at_;  // to where a record begins again
      continue;
    }
    const std::uint8_t* at = chunk_.data() + chunk_at_;
    const std::size_t header = numberAt(at);
    chunk_at_ += size;
    if (take(inner_, at + 8 + header, size - 8 - header, message)) return true;
  }
  chunk_.clear();
  return false;
}

bool Ros1BagReader::next(BagMessage& message) {
  while (true) {
    if (nextInChunk(message)) return true;
    if (!nextRecord()) {
      if (index_at_ == 0 && lost_.empty()) {
        lost_ = name_ + ": the bag was not closed by its recorder; all that is there was read";
      }
      if (index_at_ > file_size_ && lost_.empty()) {
        lose("the bag is cut off at byte " + std::to_string(file_size_));
      }
      return false;
    }
    if (fields_.kind() == Ros1Record::kBagHeader) {
      index_at_ = fields_.longNumber("index_pos").value_or(0);
    } else if (fields_.kind() == Ros1Record::kChunk) {
      openChunk();
    } else if (take(fields_, data_.data(), data_.size(), message)) {
      return true;
    }
  }
}

}  // namespace heel
