// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A file for which there is no room.
#pragma once

#include <sys/resource.h>

#include <csignal>
#include <filesystem>

namespace heel::test {

/// Lets `file` lead to /dev/full, which takes nothing: "No space left on device".
inline void makeDiskFullFor(const std::filesystem::path& file) {
  std::filesystem::create_symlink("/dev/full", file);
}

/// While it lives, no file of this process can grow beyond `bytes`: writing fails in the middle.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : before_signal_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, before_signal_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*before_signal_)(int);
};

inline bool isThere(const std::filesystem::path& file) {
  return std::filesystem::symlink_status(file).type() != std::filesystem::file_type::not_found;
}

}  // namespace heel::test
