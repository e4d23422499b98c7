// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/bag/ros2_page_scan.hpp>

#include <algorithm>

namespace heel {
namespace {

constexpr std::uint8_t kTableLeaf = 0x0D;
constexpr std::size_t kFileHeader = 100;  // at the beginning of the first page

std::uint64_t bigEndian(const std::uint8_t* bytes, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) value = value << 8U | bytes[i];
  return value;
}

/// Takes a number of 1 to 9 bytes, whose high bits say whether more follow.
std::optional<std::uint64_t> varint(const std::uint8_t*& at, const std::uint8_t* end) {
  std::uint64_t value = 0;
  for (int i = 0; i < 9 && at < end; ++i) {
    const std::uint8_t byte = *at++;
    if (i == 8) return value << 8U | byte;
    value = value << 7U | (byte & 0x7FU);
    if ((byte & 0x80U) == 0) return value;
  }
  return std::nullopt;
}

/// Takes an integer of a record; absent if the type is another.
std::optional<std::int64_t> integer(std::uint64_t type, const std::uint8_t*& at,
                                    const std::uint8_t* end) {
  constexpr std::size_t kSizes[] = {0, 1, 2, 3, 4, 6, 8};
  if (type == 8 || type == 9) return type == 9 ? 1 : 0;
  if (type < 1 || type > 6) return std::nullopt;
  const std::size_t size = kSizes[type];
  if (static_cast<std::size_t>(end - at) < size) return std::nullopt;
  const auto shift = static_cast<unsigned>(64 - 8 * size);
  // NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult): a size is not 0.
  const auto value = static_cast<std::int64_t>(bigEndian(at, size) << shift) >> shift;
  at += size;
  return value;
}

}  // namespace

Ros2PageScan::Ros2PageScan(const std::filesystem::path& file) : in_(file, std::ios::binary) {
  Bytes header(kFileHeader);
  if (!in_.read(reinterpret_cast<char*>(header.data()), kFileHeader)) return;
  page_size_ = static_cast<std::size_t>(bigEndian(&header[16], 2));
  if (page_size_ == 1) page_size_ = 65536;
  if (page_size_ < 512 || header[20] > page_size_ / 2) return;
  usable_ = page_size_ - header[20];
  pages_ = std::filesystem::file_size(file) / page_size_;
}

bool Ros2PageScan::readPage(std::uint64_t number, Bytes& page) {
  if (number < 1 || number > pages_) return false;
  page.resize(page_size_);
  in_.clear();
  in_.seekg(static_cast<std::streamoff>((number - 1) * page_size_));
  return !in_.read(reinterpret_cast<char*>(page.data()), static_cast<std::streamsize>(page_size_))
              .fail();
}

std::optional<Ros2PageScan::Row> Ros2PageScan::next() {
  while (true) {
    const std::size_t header = page_number_ == 1 ? kFileHeader : 0;
    while (cell_ < cells_) {
      const std::size_t pointer = header + 8 + 2 * cell_++;
      Row row;
      if (pointer + 2 > usable_) break;
      if (readCell(static_cast<std::size_t>(bigEndian(&page_[pointer], 2)), row)) return row;
    }
    cell_ = cells_ = 0;
    if (page_number_ >= pages_) return std::nullopt;
    if (!readPage(++page_number_, page_)) return std::nullopt;
    const std::uint8_t* begin = page_.data() + (page_number_ == 1 ? kFileHeader : 0);
    if (*begin == kTableLeaf) cells_ = static_cast<std::size_t>(bigEndian(begin + 3, 2));
  }
}

/// Puts a row's bytes together: those on its page, and on the pages that it overflows to.
bool Ros2PageScan::readCell(std::size_t offset, Row& row) {
  if (offset >= usable_) return false;
  const std::uint8_t *at = page_.data() + offset, *end = page_.data() + usable_;
  const auto size = varint(at, end), id = varint(at, end);
  if (!size || !id || *size > pages_ * page_size_) return false;
  row.id = static_cast<std::int64_t>(*id);
  const std::size_t most = usable_ - 35, least = (usable_ - 12) * 32 / 255 - 23;
  std::size_t local = *size;
  if (local > most) {
    local = least + (*size - least) % (usable_ - 4);
    if (local > most) local = least;
  }
  const bool overflows = local < *size;
  if (static_cast<std::size_t>(end - at) < local + (overflows ? 4 : 0)) return false;
  payload_.assign(at, at + local);
  if (overflows &&
      !addOverflow(static_cast<std::uint32_t>(bigEndian(at + local, 4)), *size - local)) {
    return false;
  }
  return parseRecord(row);
}

bool Ros2PageScan::addOverflow(std::uint32_t page, std::size_t size) {
  while (size > 0) {
    if (!readPage(page, overflow_)) return false;
    const std::size_t part = std::min(size, usable_ - 4);
    payload_.insert(payload_.end(), overflow_.begin() + 4,
                    overflow_.begin() + 4 + static_cast<std::ptrdiff_t>(part));
    page = static_cast<std::uint32_t>(bigEndian(overflow_.data(), 4));
    size -= part;
  }
  return true;
}

/// A message's record has the columns id (in the row's number, here nothing), topic_id, timestamp
/// and data.
bool Ros2PageScan::parseRecord(Row& row) const {
  const std::uint8_t *at = payload_.data(), *end = at + payload_.size();
  const auto header_size = varint(at, end);
  if (!header_size || *header_size > payload_.size()) return false;
  const std::uint8_t* values = payload_.data() + *header_size;
  const auto id = varint(at, values), topic = varint(at, values), stamp = varint(at, values),
             data = varint(at, values);
  if (!data || at != values || *id != 0 || *data < 12 || *data % 2 != 0) return false;
  const auto topic_id = integer(*topic, values, end), stamp_ns = integer(*stamp, values, end);
  row.size = static_cast<std::size_t>((*data - 12) / 2);
  if (!topic_id || !stamp_ns || static_cast<std::size_t>(end - values) < row.size) return false;
  row.topic_id = *topic_id;
  row.stamp_ns = *stamp_ns;
  row.data = values;
  return true;
}

}  // namespace heel
