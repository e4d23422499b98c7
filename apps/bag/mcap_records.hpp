// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The records of an MCAP file (https://mcap.dev/spec).
#pragma once

#include <heel/apps/bag/chunk_packing.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace heel {

/// Begins and ends a file.
inline constexpr std::string_view kMcapMagic = "\x89MCAP0\r\n";

/// What a record is.
enum class McapRecord : std::uint8_t {
  kHeader = 1,
  kFooter = 2,
  kSchema = 3,
  kChannel = 4,
  kMessage = 5,
  kChunk = 6,
  kMessageIndex = 7,
  kChunkIndex = 8,
  kStatistics = 11,
  kSummaryOffset = 14,
  kDataEnd = 15,
};

/// Before each record's content: what it is, and its length.
inline constexpr std::size_t kMcapRecordHead = 9;

/// Takes the fields of a record from its bytes. Where they end too early, what is taken is 0 or
/// empty, and so is the rest.
class McapFields {
 public:
  McapFields(const std::uint8_t* bytes, std::size_t size) : at_(bytes), left_(size) {}

  bool ok() const { return ok_; }
  std::size_t left() const { return left_; }
  const std::uint8_t* rest() const { return at_; }

  template <class T>
  T number() {
    T value{};
    if (const std::uint8_t* bytes = take(sizeof(T))) std::memcpy(&value, bytes, sizeof(T));
    return value;
  }
  std::int64_t time() { return static_cast<std::int64_t>(number<std::uint64_t>()); }

  std::string_view text() {
    const auto size = number<std::uint32_t>();
    const std::uint8_t* bytes = take(size);
    if (bytes == nullptr) return {};
    return {reinterpret_cast<const char*>(bytes), size};
  }

  /// A list, as the fields of its elements.
  McapFields list() {
    const std::string_view bytes = text();
    McapFields fields(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    fields.ok_ = ok_;
    return fields;
  }

 private:
  const std::uint8_t* take(std::uint64_t size) {
    if (size > left_) ok_ = false;
    if (!ok_) return nullptr;
    const std::uint8_t* bytes = at_;
    at_ += size;
    left_ -= static_cast<std::size_t>(size);
    return bytes;
  }

  const std::uint8_t* at_;
  std::size_t left_;
  bool ok_ = true;
};

/// Appends the fields of a record to bytes.
class McapContent {
 public:
  const BagBytes& bytes() const { return bytes_; }

  template <class T>
  McapContent& number(T value) {
    return put(&value, sizeof(T));
  }
  McapContent& time(std::int64_t ns) { return number(static_cast<std::uint64_t>(ns)); }

  McapContent& text(std::string_view text) {
    number(static_cast<std::uint32_t>(text.size()));
    return put(text.data(), text.size());
  }
  McapContent& list(const McapContent& elements) {
    number(static_cast<std::uint32_t>(elements.bytes_.size()));
    return raw(elements.bytes_);
  }
  McapContent& raw(const BagBytes& bytes) { return put(bytes.data(), bytes.size()); }

 private:
  McapContent& put(const void* bytes, std::size_t size);

  BagBytes bytes_;
};

/// Appends a record.
void appendRecord(BagBytes& bytes, McapRecord kind, const McapContent& content);

/// The checksum of MCAP's records, gone on with; it begins with 0.
std::uint32_t mcapCrc(const std::uint8_t* bytes, std::size_t size, std::uint32_t before = 0);

}  // namespace heel
