// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Messages as bytes, in both forms; little-endian.
///
/// ROS 1 packs a message's fields. CDR (ROS 2) begins with 4 bytes that tell the encoding, aligns
/// numbers to their size, and ends strings with a 0 that it counts.
#pragma once

#include <heel/apps/bag/messages.hpp>

#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <type_traits>

namespace heel {

template <class T>
struct IsVector : std::false_type {};
template <class T>
struct IsVector<std::vector<T>> : std::true_type {};
template <class T>
struct IsArray : std::false_type {};
template <class T, std::size_t N>
struct IsArray<std::array<T, N>> : std::true_type {};

/// Appends a message's fields to bytes.
template <BagForm Form>
class MessageWriter {
 public:
  static constexpr BagForm kForm = Form;

  /// @param bytes  Out: emptied first; its memory is used again.
  explicit MessageWriter(std::vector<std::uint8_t>& bytes) : bytes_(bytes) {
    bytes_.clear();
    if constexpr (Form == BagForm::kRos2) bytes_ = {0, 1, 0, 0};  // plain CDR, little-endian
  }

  template <class T>
  void operator()(const char* /*name*/, const T& value) {
    put(value);
  }

  template <class T>
  void put(const T& value) {
    if constexpr (std::is_arithmetic_v<T>) {
      putMany(&value, 1);
    } else if constexpr (std::is_same_v<T, StampMsg> || std::is_same_v<T, DurationMsg>) {
      const std::int64_t sec = value.ns / kSecond - (value.ns % kSecond < 0 ? 1 : 0);
      put(static_cast<std::int32_t>(sec));
      put(static_cast<std::uint32_t>(value.ns - sec * kSecond));
    } else if constexpr (std::is_same_v<T, std::string>) {
      constexpr std::size_t kEnd = Form == BagForm::kRos2 ? 1 : 0;
      put(static_cast<std::uint32_t>(value.size() + kEnd));
      putMany(value.c_str(), value.size() + kEnd);
    } else if constexpr (IsVector<T>::value) {
      put(static_cast<std::uint32_t>(value.size()));
      putElements(value);
    } else if constexpr (IsArray<T>::value) {
      putElements(value);
    } else {
      T::fields(value, *this);
    }
  }

 private:
  static constexpr std::int64_t kSecond = 1000000000;
  static constexpr std::size_t kEncoding = 4;  // bytes that alignment does not count

  template <class List>
  void putElements(const List& list) {
    if constexpr (std::is_arithmetic_v<typename List::value_type>) {
      putMany(list.data(), list.size());
    } else {
      for (const auto& element : list) put(element);
    }
  }

  template <class T>
  void putMany(const T* values, std::size_t count) {
    if (count == 0) return;
    std::size_t at = bytes_.size();
    if constexpr (Form == BagForm::kRos2) {
      at = kEncoding + (at - kEncoding + sizeof(T) - 1) / sizeof(T) * sizeof(T);
    }
    bytes_.resize(at + count * sizeof(T));
    std::memcpy(&bytes_[at], values, count * sizeof(T));
  }

  std::vector<std::uint8_t>& bytes_;
};

/// Takes a message's fields from bytes.
template <BagForm Form>
class MessageReader {
 public:
  static constexpr BagForm kForm = Form;

  /// @throws std::runtime_error  if the bytes are in another encoding; as all of it if they end
  ///         before the message does.
  MessageReader(const std::uint8_t* bytes, std::size_t size) : bytes_(bytes), size_(size) {
    if constexpr (Form == BagForm::kRos2) {
      if (size < kEncoding) fail();
      if (bytes[0] != 0 || bytes[1] != 1) {
        throw std::runtime_error("the message is not plain little-endian CDR");
      }
      at_ = kEncoding;
    }
  }

  template <class T>
  void operator()(const char* /*name*/, T& value) {
    get(value);
  }

  template <class T>
  void get(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      std::uint8_t byte = 0;
      getMany(&byte, 1);
      value = byte != 0;
    } else if constexpr (std::is_arithmetic_v<T>) {
      getMany(&value, 1);
    } else if constexpr (std::is_same_v<T, StampMsg> || std::is_same_v<T, DurationMsg>) {
      // ROS 1 stamps have unsigned seconds, but none is after 2038 yet.
      std::int32_t sec = 0;
      std::uint32_t ns = 0;
      get(sec);
      get(ns);
      value.ns = std::int64_t{sec} * 1000000000 + ns;
    } else if constexpr (std::is_same_v<T, std::string>) {
      const std::size_t length = count();
      value.assign(reinterpret_cast<const char*>(bytes_ + at_), length);
      at_ += length;
      if (Form == BagForm::kRos2 && !value.empty()) value.pop_back();
    } else if constexpr (IsVector<T>::value) {
      const std::size_t length = count();
      if constexpr (std::is_arithmetic_v<typename T::value_type>) {
        if (length > (size_ - at_) / sizeof(typename T::value_type)) fail();
        value.resize(length);
        getMany(value.data(), length);
      } else {
        value.clear();  // and grown only as far as there are bytes, whatever the count says
        for (std::size_t i = 0; i < length; ++i) get(value.emplace_back());
      }
    } else if constexpr (IsArray<T>::value) {
      getMany(value.data(), value.size());
    } else {
      T::fields(value, *this);
    }
  }

 private:
  static constexpr std::size_t kEncoding = 4;  // bytes that alignment does not count

  [[noreturn]] static void fail() { throw std::runtime_error("the message ends too early"); }

  /// A number of elements, each of which takes a byte at least.
  std::size_t count() {
    std::uint32_t number = 0;
    getMany(&number, 1);
    if (number > size_ - at_) fail();
    return number;
  }

  template <class T>
  void getMany(T* values, std::size_t count) {
    if (count == 0) return;
    if constexpr (Form == BagForm::kRos2) {
      at_ = kEncoding + (at_ - kEncoding + sizeof(T) - 1) / sizeof(T) * sizeof(T);
    }
    if (at_ > size_ || count > (size_ - at_) / sizeof(T)) fail();
    std::memcpy(values, bytes_ + at_, count * sizeof(T));
    at_ += count * sizeof(T);
  }

  const std::uint8_t* bytes_;
  std::size_t size_;
  std::size_t at_ = 0;
};

/// Reads a whole message into `message`, whose memory is used again.
/// @throws std::runtime_error  if the bytes are not such a message.
template <class Message>
void readMessage(BagForm form, const std::uint8_t* bytes, std::size_t size, Message& message) {
  if (form == BagForm::kRos1) {
    MessageReader<BagForm::kRos1>(bytes, size).get(message);
  } else {
    MessageReader<BagForm::kRos2>(bytes, size).get(message);
  }
}

template <class Message>
void writeMessage(BagForm form, const Message& message, std::vector<std::uint8_t>& bytes) {
  if (form == BagForm::kRos1) {
    MessageWriter<BagForm::kRos1>(bytes).put(message);
  } else {
    MessageWriter<BagForm::kRos2>(bytes).put(message);
  }
}

}  // namespace heel
