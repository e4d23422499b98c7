// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/report/atomic_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace heel {

namespace fs = std::filesystem;

namespace {

void removeQuietly(const fs::path& file) {
  std::error_code ignored;
  fs::remove(file, ignored);
}

[[noreturn]] void failToWrite(const fs::path& file, const std::string& why) {
  throw std::runtime_error(file.string() + " cannot be written: " + why);
}

}  // namespace

fs::path temporaryBeside(const fs::path& file) {
  fs::path name = ".";
  name += file.stem();
  name += ".part";
  name += file.extension();
  return file.parent_path() / name;
}

void commitTemporary(const fs::path& temporary, const fs::path& file) {
  std::error_code error;
  fs::rename(temporary, file, error);
  if (error) {
    removeQuietly(temporary);
    failToWrite(file, error.message());
  }
}

AtomicFile::AtomicFile(fs::path path) : path_(std::move(path)), temporary_(temporaryBeside(path_)) {
  file_.reset(std::fopen(temporary_.c_str(), "wb"));
  if (file_ == nullptr) failToWrite(path_, std::generic_category().message(errno));
}

AtomicFile::~AtomicFile() {
  if (is_pending_) discard();
}

void AtomicFile::discard() {
  file_.reset();
  removeQuietly(temporary_);
  is_pending_ = false;
}

void AtomicFile::fail(int reason) {
  discard();
  failToWrite(path_, std::generic_category().message(reason));
}

void AtomicFile::write(std::string_view text) {
  if (file_ == nullptr) throw std::logic_error("AtomicFile: written to after its end");
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) fail(errno);
}

void AtomicFile::close() {
  if (file_ == nullptr) return;
  if (std::fflush(file_.get()) != 0) fail(errno);
  // Some file systems tell only here that there is no room. Devices and pipes can't be synced.
  if (fsync(fileno(file_.get())) != 0 && errno != EINVAL) fail(errno);
  if (std::fclose(file_.release()) != 0) fail(errno);
}

void AtomicFile::commit() {
  if (!is_pending_) throw std::logic_error("AtomicFile: committed after its end");
  close();
  is_pending_ = false;
  commitTemporary(temporary_, path_);
}

void writeFile(const fs::path& path, std::string_view text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

}  // namespace heel
