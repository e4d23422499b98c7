// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Keeps PCL from writing to the console.
#pragma once

#include <pcl/console/print.h>

namespace heel {

/// PCL's readers tell their reasons to the console; ours go to the caller instead. Where PCL is
/// silent already, nothing is changed, so that threads can share the silence.
class QuietPcl {
 public:
  QuietPcl() : before_(pcl::console::getVerbosityLevel()) { set(pcl::console::L_ALWAYS); }
  ~QuietPcl() { set(before_); }
  QuietPcl(const QuietPcl&) = delete;
  QuietPcl& operator=(const QuietPcl&) = delete;

 private:
  void set(pcl::console::VERBOSITY_LEVEL level) const {
    if (before_ != pcl::console::L_ALWAYS) pcl::console::setVerbosityLevel(level);
  }

  pcl::console::VERBOSITY_LEVEL before_;
};

}  // namespace heel
