// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Debian's roscore, for tests of ROS 1.
#pragma once

#include "tests/support/temp_folder.hpp"

#include <sys/types.h>

#include <string>

namespace heel::test {

/// A roscore on a port of its own. The environment leads this process, and those that it starts, to
/// it. It ends with the test, however that ends.
class Roscore {
 public:
  static bool isInstalled();

  Roscore();
  ~Roscore() { stop(); }
  Roscore(const Roscore&) = delete;
  Roscore& operator=(const Roscore&) = delete;

  /// Waits until it answers.
  /// @throws std::runtime_error  if it does not.
  void start();
  void stop();

 private:
  TempFolder folder_;
  int port_ = 0;
  pid_t process_ = -1;
};

}  // namespace heel::test
