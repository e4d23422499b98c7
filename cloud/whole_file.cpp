// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/file_limits.hpp>
#include <heel/cloud/whole_file.hpp>

#include <cerrno>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <system_error>

namespace heel {
namespace {

namespace fs = std::filesystem;

std::error_code lastError() { return {errno, std::generic_category()}; }

/// @return What went wrong, if anything.
std::error_code writeBytes(const fs::path& file, std::string_view bytes) {
  std::FILE* out = std::fopen(file.c_str(), "wb");
  if (out == nullptr) return lastError();
  std::error_code error;
  if (std::fwrite(bytes.data(), 1, bytes.size(), out) != bytes.size()) error = lastError();
  if (std::fclose(out) != 0 && !error) error = lastError();
  return error;
}

}  // namespace

std::string readWholeFile(const fs::path& file) {
  const auto fail = [&](const std::string& why) {
    throw std::runtime_error(file.string() + " cannot be read: " + why);
  };
  std::error_code error;
  if (fs::is_directory(file, error)) fail("it is a folder");
  checkIsFile(file);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> in(std::fopen(file.c_str(), "rb"),
                                                           &std::fclose);
  if (in == nullptr) fail(lastError().message());
  const auto size = fs::file_size(file, error);
  if (error) fail(error.message());
  std::string bytes(size, '\0');
  if (std::fread(bytes.data(), 1, bytes.size(), in.get()) != bytes.size()) {
    fail("it ends before its end");
  }
  return bytes;
}

void writeWholeFile(const fs::path& file, std::string_view bytes) {
  fs::path part = file;
  part += ".part";
  std::error_code error = writeBytes(part, bytes);
  if (!error) fs::rename(part, file, error);
  if (!error) return;
  std::error_code ignored;
  fs::remove(part, ignored);
  throw std::runtime_error(file.string() + " cannot be written: " + error.message());
}

}  // namespace heel
