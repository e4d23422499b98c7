// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Bags that a recorder has split.
#pragma once

#include <heel/apps/bag/bag.hpp>

#include <optional>

namespace heel {

/// The MCAP files of a ROS 2 bag, or the pieces of a ROS 1 bag, one after the other.
class BagSequence final : public BagReader {
 public:
  /// @throws std::runtime_error  if none of them can be opened.
  BagSequence(const std::filesystem::path& path, const std::vector<std::filesystem::path>& files);

  BagForm form() const override { return files_.front()->form(); }
  const BagIndex* index() override;
  void select(const BagQuery& query) override;
  bool next(BagMessage& message) override;

 private:
  std::size_t topicOf(std::size_t file, std::size_t topic);

  std::string name_, unopened_;
  std::vector<std::unique_ptr<BagReader>> files_;
  std::vector<std::vector<std::size_t>> topics_of_files_;  // theirs as ours
  std::optional<BagIndex> index_;
  std::size_t file_ = 0;
};

}  // namespace heel
