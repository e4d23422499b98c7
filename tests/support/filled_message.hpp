// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Messages with something in every field.
#pragma once

#include <heel/apps/bag/message_archives.hpp>

#include <string>

namespace heel::test {

/// Gives every field a value of its own, and every list two elements.
class MessageFiller {
 public:
  static constexpr BagForm kForm = BagForm::kRos2;  // all fields, ROS 1's "seq" apart

  template <class T>
  void operator()(const char* /*name*/, T& value) {
    fill(value);
  }

  template <class T>
  void fill(T& value) {
    ++number_;
    if constexpr (std::is_same_v<T, bool>) {
      value = true;
    } else if constexpr (std::is_arithmetic_v<T>) {
      value = static_cast<T>(number_ % 100);
    } else if constexpr (std::is_same_v<T, StampMsg> || std::is_same_v<T, DurationMsg>) {
      value.ns = number_ * 1000000007LL;
    } else if constexpr (std::is_same_v<T, std::string>) {
      value = "text " + std::string(static_cast<std::size_t>(number_ % 7), 'x');
    } else if constexpr (IsVector<T>::value) {
      value.resize(2);
      for (auto& element : value) fill(element);
    } else if constexpr (IsArray<T>::value) {
      for (auto& element : value) fill(element);
    } else {
      T::fields(value, *this);
    }
  }

 private:
  int number_ = 0;
};

template <class Message>
Message filled() {
  Message message;
  MessageFiller().fill(message);
  return message;
}

}  // namespace heel::test
