// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/bag/bag_file.hpp>
#include <heel/cloud/files.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>

namespace heel {

BagFile::Descriptor::~Descriptor() {
  if (file_ >= 0) close(file_);
}

BagFile::BagFile(const std::filesystem::path& path) : name_(path.string()) {
  checkIsFile(path);
  file_ = std::make_unique<Descriptor>(open(name_.c_str(), O_RDONLY | O_CLOEXEC));
  if (file_->get() < 0) throw std::runtime_error(name_ + ": can't be opened");
  std::error_code problem;
  size_ = std::filesystem::file_size(path, problem);
  if (problem) throw std::runtime_error(name_ + ": " + problem.message());
  if (size_ == 0) throw std::runtime_error(name_ + ": the bag is empty (0 bytes)");
}

bool BagFile::read(std::uint64_t at, std::uint64_t count, BagBytes& bytes) const {
  const std::uint64_t there = at < size_ ? std::min(count, size_ - at) : 0;
  bytes.resize(static_cast<std::size_t>(there));
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t now =
        pread(file_->get(), &bytes[done], bytes.size() - done, static_cast<off_t>(at + done));
    if (now <= 0) break;
    done += static_cast<std::size_t>(now);
  }
  bytes.resize(done);
  return done == count;
}

const std::uint8_t* BagWindow::at(std::uint64_t offset, std::uint64_t count) {
  constexpr std::uint64_t kLeast = 2048;  // the next look is often near
  if (offset > size_ || count > size_ - offset) return nullptr;
  if (bytes_ != nullptr) return bytes_->data() + offset;
  if (offset < piece_at_ || offset + count > piece_at_ + piece_.size()) {
    piece_at_ = offset;
    file_->read(begin_ + offset, std::min(std::max(count, kLeast), size_ - offset), piece_);
    if (piece_.size() < count) return nullptr;
  }
  return piece_.data() + (offset - piece_at_);
}

}  // namespace heel
