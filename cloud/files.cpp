// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/files.hpp>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <limits>
#include <memory>
#include <stdexcept>
#include <system_error>

namespace heel {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMiB = std::size_t{1} << 20U;
constexpr std::size_t kAlwaysAllowed = 512 * kMiB;
constexpr std::size_t kTimesTheFile = 64;

std::string inMiB(std::size_t bytes) {
  return std::to_string(bytes / kMiB + (bytes % kMiB > 0 ? 1 : 0)) + " MiB";
}

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

std::size_t timesAtMost(std::size_t a, std::size_t b) {
  std::size_t product = 0;
  return __builtin_mul_overflow(a, b, &product) ? std::numeric_limits<std::size_t>::max() : product;
}

std::size_t memoryLimit(std::size_t file_bytes) {
  rlimit process{};
  if (getrlimit(RLIMIT_DATA, &process) == 0 && process.rlim_cur != RLIM_INFINITY) {
    return process.rlim_cur;
  }
  const auto machine = timesAtMost(static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)),
                                   static_cast<std::size_t>(sysconf(_SC_PAGESIZE)));
  return std::min(machine / 2, std::max(kAlwaysAllowed, timesAtMost(kTimesTheFile, file_bytes)));
}

void setMemoryLimit(std::size_t bytes) {
  rlimit process{};
  getrlimit(RLIMIT_DATA, &process);
  process.rlim_cur = bytes;
  if (setrlimit(RLIMIT_DATA, &process) != 0) {
    throw std::runtime_error("the system does not allow " + inMiB(bytes) + " of memory");
  }
}

void checkMemory(const std::string& what, std::size_t bytes, std::size_t file_bytes) {
  const std::size_t limit = memoryLimit(file_bytes);
  if (bytes <= limit) return;
  throw std::runtime_error(what + " asks for " + inMiB(bytes) + " of memory, and " + inMiB(limit) +
                           " is the limit (--max-memory)");
}

void checkIsFile(const std::filesystem::path& file) {
  std::error_code error;
  const auto kind = std::filesystem::status(file, error).type();
  using Type = std::filesystem::file_type;
  if (kind == Type::fifo || kind == Type::socket || kind == Type::character ||
      kind == Type::block) {
    throw std::runtime_error(file.string() + ": it is a pipe or a device, not a file");
  }
}

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
