// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/bag/mcap_records.hpp>

#include <zlib.h>

namespace heel {

McapContent& McapContent::put(const void* bytes, std::size_t size) {
  const std::size_t at = bytes_.size();
  bytes_.resize(at + size);
  if (size > 0) std::memcpy(&bytes_[at], bytes, size);
  return *this;
}

void appendRecord(BagBytes& bytes, McapRecord kind, const McapContent& content) {
  McapContent head;
  head.number(kind).number<std::uint64_t>(content.bytes().size());
  bytes.insert(bytes.end(), head.bytes().begin(), head.bytes().end());
  bytes.insert(bytes.end(), content.bytes().begin(), content.bytes().end());
}

std::uint32_t mcapCrc(const std::uint8_t* bytes, std::size_t size, std::uint32_t before) {
  return static_cast<std::uint32_t>(crc32_z(before, bytes, size));
}

}  // namespace heel
