// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A bag that is never complete: messages are put in at one end and read at the other.
#pragma once

#include <heel/apps/bag/bag.hpp>

#include <algorithm>
#include <deque>
#include <utility>

namespace heel {

/// Gives back what it was fed, in that order, so that what reads bags reads a live robot, too.
/// next() is false when nothing waits, and true again after more was fed. Messages of
/// topics that were not selected are not kept.
class FedBagReader final : public BagReader {
 public:
  using BagReader::wants;

  /// @param form  Of what it will be fed.
  explicit FedBagReader(BagForm form) : form_(form) {}

  BagForm form() const override { return form_; }
  const BagIndex* index() override { return nullptr; }
  void select(const BagQuery& query) override { query_ = query; }

  void feed(const BagTopic& topic, std::int64_t stamp_ns, std::vector<std::uint8_t> bytes) {
    if (!wants(topic.name, stamp_ns)) return;
    const auto known = std::find_if(topics_.begin(), topics_.end(),
                                    [&](const BagTopic& t) { return t.name == topic.name; });
    const auto i = static_cast<std::size_t>(known - topics_.begin());
    if (known == topics_.end()) topics_.push_back(topic);
    waiting_.push_back({i, stamp_ns, std::move(bytes)});
  }

  bool next(BagMessage& message) override {
    if (waiting_.empty()) return false;
    present_ = std::move(waiting_.front());
    waiting_.pop_front();
    message = {present_.topic, present_.stamp_ns, present_.bytes.data(), present_.bytes.size()};
    return true;
  }

 private:
  struct Message {
    std::size_t topic = 0;
    std::int64_t stamp_ns = 0;
    std::vector<std::uint8_t> bytes;
  };
  BagForm form_;
  std::deque<Message> waiting_;
  Message present_;
};

}  // namespace heel
