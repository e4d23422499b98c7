// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// How programs are, and words to them, as messages; see messages.hpp.
#pragma once

#include <heel/apps/bag/geometry_messages.hpp>

#include <string>
#include <vector>

namespace heel {

struct StringMsg {
  static constexpr const char* kType = "std_msgs/String";
  static constexpr const char* kMd5 = "992ce8a1687cec8c8bd883ec73ca41d1";
  std::string data;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("data", m.data);
  }
};

struct KeyValueMsg {
  static constexpr const char* kType = "diagnostic_msgs/KeyValue";
  std::string key, value;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("key", m.key);
    a("value", m.value);
  }
};

struct DiagnosticStatusMsg {
  static constexpr const char* kType = "diagnostic_msgs/DiagnosticStatus";
  static constexpr const char* kConstants = "byte OK=0\nbyte WARN=1\nbyte ERROR=2\nbyte STALE=3\n";
  enum Level : char { kOk = 0, kWarn = 1, kError = 2 };
  char level = kOk;  ///< What ROS calls a byte.
  std::string name, message, hardware_id;
  std::vector<KeyValueMsg> values;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("level", m.level);
    a("name", m.name);
    a("message", m.message);
    a("hardware_id", m.hardware_id);
    a("values", m.values);
  }
};

struct DiagnosticArrayMsg {
  static constexpr const char* kType = "diagnostic_msgs/DiagnosticArray";
  static constexpr const char* kMd5 = "60810da900de1dd6ddd437c3503511da";
  HeaderMsg header;
  std::vector<DiagnosticStatusMsg> status;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("header", m.header);
    a("status", m.status);
  }
};

}  // namespace heel
