// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// How much memory a long run holds.
#pragma once

#include <unistd.h>

#include <fstream>

namespace heel {

/// Resident memory of this process [MiB]; 0 where the system does not tell.
inline double residentMemory_MiB() {
  std::ifstream statm("/proc/self/statm");
  double all = 0.0, resident = 0.0;  // in pages
  if (!(statm >> all >> resident)) return 0.0;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
}

}  // namespace heel
