// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/bag/bag_sequence.hpp>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace heel {

BagSequence::BagSequence(const std::filesystem::path& path,
                         const std::vector<std::filesystem::path>& files)
    : name_(path.string()) {
  std::string first_problem;
  for (const auto& file : files) {
    try {
      auto reader = openBag(file);
      if (!files_.empty() && reader->form() != form()) {
        throw std::runtime_error(file.string() + ": its messages are of another form");
      }
      files_.push_back(std::move(reader));
    } catch (const std::runtime_error& error) {
      if (first_problem.empty()) first_problem = error.what();
      unopened_ =
          name_ + ": " + file.filename().string() + " can't be read; what else is there was read";
    }
  }
  if (files_.empty()) throw std::runtime_error(first_problem);
  topics_of_files_.resize(files_.size());
  select({});
  for (std::size_t i = 0; i < files_.size(); ++i) {
    for (std::size_t t = 0; t < files_[i]->topics().size(); ++t) topicOf(i, t);
  }
}

std::size_t BagSequence::topicOf(std::size_t file, std::size_t topic) {
  auto& known = topics_of_files_[file];
  while (known.size() <= topic) {
    const BagTopic& theirs = files_[file]->topics()[known.size()];
    const auto same = std::find_if(topics_.begin(), topics_.end(), [&](const BagTopic& ours) {
      return ours.name == theirs.name && ours.type == theirs.type;
    });
    known.push_back(static_cast<std::size_t>(same - topics_.begin()));
    if (same == topics_.end()) topics_.push_back(theirs);
  }
  return known[topic];
}

const BagIndex* BagSequence::index() {
  if (index_) return &*index_;
  BagIndex whole;
  whole.topics.resize(topics_.size());
  bool is_first = true;
  const auto widen = [](auto& span, const auto& part, bool first) {
    span.first_ns = first ? part.first_ns : std::min(span.first_ns, part.first_ns);
    span.last_ns = first ? part.last_ns : std::max(span.last_ns, part.last_ns);
  };
  for (std::size_t i = 0; i < files_.size(); ++i) {
    const BagIndex* part = files_[i]->index();
    if (part == nullptr) return nullptr;
    for (std::size_t t = 0; t < part->topics.size(); ++t) {
      if (part->topics[t].count == 0) continue;
      BagIndex::Topic& topic = whole.topics[topicOf(i, t)];
      widen(topic, part->topics[t], topic.count == 0);
      widen(whole, part->topics[t], std::exchange(is_first, false));
      topic.count += part->topics[t].count;
    }
  }
  index_ = std::move(whole);
  return &*index_;
}

void BagSequence::select(const BagQuery& query) {
  for (const auto& file : files_) file->select(query);
  file_ = 0;
  lost_ = unopened_;
}

bool BagSequence::next(BagMessage& message) {
  for (; file_ < files_.size(); ++file_) {
    if (files_[file_]->next(message)) {
      message.topic = topicOf(file_, message.topic);
      return true;
    }
    if (lost_.empty()) lost_ = files_[file_]->lost();
  }
  return false;
}

}  // namespace heel
