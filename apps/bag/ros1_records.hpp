// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The records of a ROS 1 bag (format 2.0).
#pragma once

#include <heel/apps/bag/chunk_packing.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace heel {

inline constexpr std::string_view kRos1Magic = "#ROSBAG V2.0\n";

/// What a record is.
enum class Ros1Record : std::uint8_t {
  kMessage = 2,
  kBagHeader = 3,
  kIndex = 4,
  kChunk = 5,
  kChunkInfo = 6,
  kConnection = 7,
};

/// The fields "name=value" that begin each record.
class Ros1Fields {
 public:
  /// False if the bytes are not such fields.
  bool parse(const std::uint8_t* bytes, std::size_t size);

  std::optional<std::string_view> text(const std::string& name) const;
  std::optional<Ros1Record> kind() const;
  std::optional<std::uint32_t> number(const std::string& name) const;
  std::optional<std::uint64_t> longNumber(const std::string& name) const;
  /// Seconds and nanoseconds, as nanoseconds.
  std::optional<std::int64_t> time(const std::string& name) const;

  Ros1Fields& set(const std::string& name, std::string_view value);
  Ros1Fields& set(Ros1Record kind);
  Ros1Fields& set(const std::string& name, std::uint32_t value);
  Ros1Fields& setLong(const std::string& name, std::uint64_t value);
  Ros1Fields& setTime(const std::string& name, std::int64_t ns);

  /// The fields as bytes, without their length.
  void append(BagBytes& bytes) const;

 private:
  std::map<std::string, std::string, std::less<>> values_;
};

/// Appends a little-endian number.
void appendNumber(BagBytes& bytes, std::uint32_t value);
std::uint32_t numberAt(const std::uint8_t* bytes);

/// Appends a record: lengths, fields, data.
void appendRecord(BagBytes& bytes, const Ros1Fields& fields, const BagBytes& data);

}  // namespace heel
