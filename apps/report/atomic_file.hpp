// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Files that are written whole or not at all.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

namespace heel {

/// Where a file is written before it gets its name: hidden, in the same folder, with the same
/// ending.
std::filesystem::path temporaryBeside(const std::filesystem::path& file);

/// Gives a written temporary its name, replacing a file that has it.
/// @throws std::runtime_error  with one sentence; the temporary is then removed.
void commitTemporary(const std::filesystem::path& temporary, const std::filesystem::path& file);

/// A file that gets its name only when it is complete.
///
/// What is written goes to a temporary beside it, so that memory does not grow; `commit()` flushes
/// it to the disk and renames it. Without a commit the temporary is removed and a file that was
/// there before stays as it was.
class AtomicFile {
 public:
  /// @throws std::runtime_error  if the folder does not exist or can't be written.
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// @throws std::runtime_error  for instance when the disk is full: one sentence that names the
  ///         file and the reason; the temporary is then removed.
  void write(std::string_view text);

  /// Ends the writing, so that commit() has nothing left to do but to give the name: files that
  /// belong together are all closed before the first gets its name.
  /// @throws std::runtime_error  as write().
  void close();

  /// Closes the file if need be, and gives it its name.
  /// @throws std::runtime_error  as write().
  void commit();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  void discard();
  [[noreturn]] void fail(int reason);

  std::filesystem::path path_;
  std::filesystem::path temporary_;
  std::unique_ptr<std::FILE, Close> file_;  ///< Null once closed.
  bool is_pending_ = true;                  ///< The temporary is there, for us to rename or remove.
};

/// Writes a whole file at once.
/// @throws std::runtime_error  as AtomicFile.
void writeFile(const std::filesystem::path& path, std::string_view text);

}  // namespace heel
