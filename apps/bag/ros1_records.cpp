// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/bag/ros1_records.hpp>

#include <cstring>

namespace heel {
namespace {

template <class T>
std::optional<T> valueOf(std::optional<std::string_view> text) {
  if (!text || text->size() != sizeof(T)) return std::nullopt;
  T value{};
  std::memcpy(&value, text->data(), sizeof(T));
  return value;
}

template <class T>
std::string bytesOf(T value) {
  std::string text(sizeof(T), '\0');
  std::memcpy(text.data(), &value, sizeof(T));
  return text;
}

}  // namespace

std::uint32_t numberAt(const std::uint8_t* bytes) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

void appendNumber(BagBytes& bytes, std::uint32_t value) {
  const std::string text = bytesOf(value);
  bytes.insert(bytes.end(), text.begin(), text.end());
}

bool Ros1Fields::parse(const std::uint8_t* bytes, std::size_t size) {
  values_.clear();
  std::size_t at = 0;
  while (at < size) {
    if (size - at < 4) return false;
    const std::size_t length = numberAt(bytes + at);
    at += 4;
    if (length > size - at) return false;
    const std::string_view field(reinterpret_cast<const char*>(bytes + at), length);
    const auto equals = field.find('=');
    if (equals == std::string_view::npos) return false;
    values_[std::string(field.substr(0, equals))] = field.substr(equals + 1);
    at += length;
  }
  return true;
}

std::optional<std::string_view> Ros1Fields::text(const std::string& name) const {
  const auto found = values_.find(name);
  if (found == values_.end()) return std::nullopt;
  return found->second;
}

std::optional<Ros1Record> Ros1Fields::kind() const {
  const auto op = valueOf<std::uint8_t>(text("op"));
  if (!op) return std::nullopt;
  return static_cast<Ros1Record>(*op);
}

std::optional<std::uint32_t> Ros1Fields::number(const std::string& name) const {
  return valueOf<std::uint32_t>(text(name));
}

std::optional<std::uint64_t> Ros1Fields::longNumber(const std::string& name) const {
  return valueOf<std::uint64_t>(text(name));
}

std::optional<std::int64_t> Ros1Fields::time(const std::string& name) const {
  const auto both = longNumber(name);
  if (!both) return std::nullopt;
  return static_cast<std::int64_t>(*both & 0xFFFFFFFFU) * 1000000000 +
         static_cast<std::int64_t>(*both >> 32U);
}

Ros1Fields& Ros1Fields::set(const std::string& name, std::string_view value) {
  values_[name] = value;
  return *this;
}

Ros1Fields& Ros1Fields::set(Ros1Record kind) {
  return set("op", std::string_view(bytesOf(static_cast<std::uint8_t>(kind))));
}

Ros1Fields& Ros1Fields::set(const std::string& name, std::uint32_t value) {
  return set(name, std::string_view(bytesOf(value)));
}

Ros1Fields& Ros1Fields::setLong(const std::string& name, std::uint64_t value) {
  return set(name, std::string_view(bytesOf(value)));
}

Ros1Fields& Ros1Fields::setTime(const std::string& name, std::int64_t ns) {
  const auto sec = static_cast<std::uint64_t>(ns / 1000000000);
  const auto rest = static_cast<std::uint64_t>(ns % 1000000000);
  return setLong(name, sec | (rest << 32U));
}

void Ros1Fields::append(BagBytes& bytes) const {
  for (const auto& [name, value] : values_) {
    appendNumber(bytes, static_cast<std::uint32_t>(name.size() + 1 + value.size()));
    bytes.insert(bytes.end(), name.begin(), name.end());
    bytes.push_back('=');
    bytes.insert(bytes.end(), value.begin(), value.end());
  }
}

void appendRecord(BagBytes& bytes, const Ros1Fields& fields, const BagBytes& data) {
  const std::size_t at = bytes.size();
  appendNumber(bytes, 0);
  fields.append(bytes);
  const auto length = static_cast<std::uint32_t>(bytes.size() - at - 4);
  std::memcpy(&bytes[at], &length, sizeof length);
  appendNumber(bytes, static_cast<std::uint32_t>(data.size()));
  bytes.insert(bytes.end(), data.begin(), data.end());
}

}  // namespace heel
