// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Bytes from anywhere in a file.
#pragma once

#include <heel/apps/bag/chunk_packing.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace heel {

/// A file that is read here and there; never more of it than there is.
class BagFile {
 public:
  /// @throws std::runtime_error  one sentence that names the file, if it can't be opened or is
  ///         empty.
  explicit BagFile(const std::filesystem::path& path);

  const std::string& name() const { return name_; }
  std::uint64_t size() const { return size_; }

  /// @param bytes  Out: `count` bytes from `at` on, or as many as there are.
  /// @return whether there are so many.
  bool read(std::uint64_t at, std::uint64_t count, BagBytes& bytes) const;

 private:
  class Descriptor {
   public:
    explicit Descriptor(int file) : file_(file) {}
    ~Descriptor();
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int get() const { return file_; }

   private:
    int file_;
  };

  std::string name_;
  std::unique_ptr<Descriptor> file_;
  std::uint64_t size_ = 0;
};

/// A part of a file, or bytes in memory, looked at piece by piece.
class BagWindow {
 public:
  explicit BagWindow(const BagBytes& bytes) : bytes_(&bytes), size_(bytes.size()) {}
  BagWindow(const BagFile& file, std::uint64_t at, std::uint64_t size)
      : file_(&file), begin_(at), size_(size) {}

  std::uint64_t size() const { return size_; }

  /// Valid until the next call. Null if there are not so many.
  const std::uint8_t* at(std::uint64_t offset, std::uint64_t count);

 private:
  const BagBytes* bytes_ = nullptr;
  const BagFile* file_ = nullptr;
  std::uint64_t begin_ = 0, size_ = 0;
  BagBytes piece_;
  std::uint64_t piece_at_ = 0;
};

}  // namespace heel
