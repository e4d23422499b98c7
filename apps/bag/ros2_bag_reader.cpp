// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/bag/ros2_bag_reader.hpp>
#include <heel/apps/bag/ros2_folder.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <utility>

namespace heel {

namespace fs = std::filesystem;

namespace {

/// Whether the file ends before its own header says. SQLite takes what is missing for zeros, and an
/// index of zeros for one without rows.
bool isCutOff(const fs::path& file) {
  std::error_code none;
  if (fs::exists(file.string() + "-wal", none)) return false;
  std::ifstream in(file, std::ios::binary);
  std::array<std::uint8_t, 100> header{};
  if (!in.read(reinterpret_cast<char*>(header.data()), header.size())) return true;
  const auto number = [&](std::size_t at, std::size_t size) {
    std::uint64_t value = 0;
    for (std::size_t i = at; i < at + size; ++i) value = value << 8U | header[i];
    return value;
  };
  const std::uint64_t page = number(16, 2) == 1 ? 65536 : number(16, 2);
  const bool tells_pages = number(24, 4) == number(92, 4);
  return tells_pages && number(28, 4) * page > fs::file_size(file, none);
}

}  // namespace

Ros2BagReader::Ros2BagReader(const fs::path& path, std::vector<fs::path> files)
    : name_(path.string()), files_(std::move(files)) {
  const fs::path& file = files_.front();
  if (files_.size() == 1 && !fs::exists(file)) {
    throw std::runtime_error(file.string() + ": the file is missing");
  }
  if (files_.size() == 1 && fs::is_regular_file(file) && fs::file_size(file) == 0) {
    throw std::runtime_error(file.string() + ": the bag is empty (0 bytes)");
  }
  if (files_.size() == 1) openFile();  // one that is of no use is an error at once
  select({});
}

void Ros2BagReader::lose(const std::string& what) {
  ++damages_;
  lost_ = name_ + ": " +
          (damages_ == 1 ? what : "the bag is damaged at " + std::to_string(damages_) + " places") +
          "; what else is there was read";
}

void Ros2BagReader::openFile() {
  const fs::path& path = files_[next_file_++];
  order_.reset();
  messages_.reset();
  file_.emplace(path, SqliteFile::Use::kRead);
  std::string missing;
  try {
    // A view could work for ever, or make up values of any size.
    for (const char* table : {"topics", "messages"}) {
      if (!file_->hasTable(table)) missing = std::string("it has no table '") + table + "'";
    }
    if (!missing.empty()) throw std::runtime_error(missing);
    readTopics();
    last_scanned_ = 0;
    last_ = {std::numeric_limits<std::int64_t>::min(), 0};
    order_.emplace(file_->query("SELECT id, timestamp, topic_id FROM messages" + condition() +
                                " ORDER BY timestamp, id"));
    messages_.emplace(
        file_->query("SELECT id, topic_id, timestamp, data FROM messages WHERE id = ?"));
  } catch (const std::runtime_error&) {
    throw std::runtime_error(path.string() +
                             ": this is no ROS 2 bag, or its beginning is damaged (" +
                             (missing.empty() ? file_->problem() : missing) + ")");
  }
  if (isCutOff(path)) goOnInScan("is cut off");
}

/// Reads the rest of a damaged file page by page.
void Ros2BagReader::goOnInScan(const std::string& why) {
  order_.reset();
  const fs::path& file = files_[next_file_ - 1];
  lose(file.filename().string() + " " + why);
  scan_.emplace(file);
}

void Ros2BagReader::readTopics() {
  topic_of_id_.clear();
  SqliteQuery list = file_->query("SELECT id, name, type, serialization_format FROM topics");
  while (true) {
    const auto row = list.step();
    if (row == SqliteQuery::Row::kBroken) file_->fail();
    if (row == SqliteQuery::Row::kEnd) return;
    if (list.text(3) != "cdr") continue;
    const BagTopic topic{printable(list.text(1)), withoutMsg(printable(list.text(2))), ""};
    const auto known = std::find_if(topics_.begin(), topics_.end(), [&](const BagTopic& other) {
      return other.name == topic.name && other.type == topic.type;
    });
    topic_of_id_[list.integer(0)] = static_cast<std::size_t>(known - topics_.begin());
    if (known == topics_.end()) topics_.push_back(topic);
  }
}

/// What of a file's rows is wanted; SQLite looks at the times first, which have an index.
std::string Ros2BagReader::condition() const {
  std::string ids;
  for (const auto& [id, topic] : topic_of_id_) {
    if (wants(topics_[topic].name)) ids += (ids.empty() ? "" : ",") + std::to_string(id);
  }
  return " WHERE timestamp >= " + std::to_string(query_.from_ns) +
         " AND timestamp <= " + std::to_string(query_.to_ns) + " AND +topic_id IN (" + ids + ")";
}

const BagIndex* Ros2BagReader::index() {
  if (!is_measured_) {
    BagIndex index;
    if (measure(index)) index_ = std::move(index);
    is_measured_ = true;
    select(query_);
  }
  return index_ ? &*index_ : nullptr;
}

/// Counts the messages, which does not look at what is in them. False if a file is damaged.
bool Ros2BagReader::measure(BagIndex& index) {
  bool is_first = true;
  for (next_file_ = 0; next_file_ < files_.size();) {
    try {
      openFile();
    } catch (const std::runtime_error&) {
      return false;
    }
    if (scan_) return false;
    SqliteQuery counts = file_->query(
        "SELECT topic_id, count(*), min(timestamp), max(timestamp) FROM messages GROUP BY "
        "topic_id");
    auto row = counts.step();
    for (; row == SqliteQuery::Row::kThere; row = counts.step()) {
      const auto found = topic_of_id_.find(counts.integer(0));
      if (found == topic_of_id_.end()) continue;
      index.topics.resize(topics_.size());
      BagIndex::Topic& topic = index.topics[found->second];
      const std::int64_t first_ns = counts.integer(2), last_ns = counts.integer(3);
      topic.first_ns = topic.count == 0 ? first_ns : std::min(topic.first_ns, first_ns);
      topic.last_ns = topic.count == 0 ? last_ns : std::max(topic.last_ns, last_ns);
      topic.count += static_cast<std::size_t>(counts.integer(1));
      index.first_ns = is_first ? first_ns : std::min(index.first_ns, first_ns);
      index.last_ns = is_first ? last_ns : std::max(index.last_ns, last_ns);
      is_first = false;
    }
    if (row == SqliteQuery::Row::kBroken) return false;
  }
  index.topics.resize(topics_.size());
  return true;
}

void Ros2BagReader::select(const BagQuery& query) {
  query_ = query;
  lost_.clear();
  damages_ = 0;
  next_file_ = 0;
  scan_.reset();
  order_.reset();
}

bool Ros2BagReader::next(BagMessage& message) {
  while (true) {
    if (scan_ && nextInScan(message)) return true;
    if (order_ && nextInFile(message)) return true;
    if (scan_) continue;
    if (next_file_ == files_.size()) return false;
    try {
      openFile();
    } catch (const std::runtime_error&) {
      const fs::path& file = files_[next_file_ - 1];
      std::error_code none;
      lose(file.filename().string() + (!fs::exists(file)                ? " is missing"
                                       : fs::file_size(file, none) == 0 ? " is empty"
                                                                        : " can't be read"));
      order_.reset();
    }
  }
}

/// In a damaged file pages may lead to each other, and rows come again and again.
bool Ros2BagReader::isNew(std::int64_t stamp_ns, std::int64_t id) {
  const std::pair<std::int64_t, std::int64_t> row(stamp_ns, id);
  if (!(row > last_)) return false;
  last_ = row;
  return true;
}

/// Goes on in the order of time; false at the end, or where scan_ goes on because of damage.
bool Ros2BagReader::nextInFile(BagMessage& message) {
  auto row = order_->step();
  while (row == SqliteQuery::Row::kThere) {
    const auto topic = topic_of_id_.find(order_->integer(2));
    const auto before = last_;
    if (topic == topic_of_id_.end() || !isNew(order_->integer(1), order_->integer(0))) break;
    messages_->reset();
    messages_->bind(1, order_->integer(0));
    const bool is_there = messages_->step() == SqliteQuery::Row::kThere &&
                          messages_->integer(2) == order_->integer(1);
    if (!is_there) {
      last_ = before;
      break;
    }
    message.topic = topic->second;
    message.stamp_ns = messages_->integer(2);
    message.data = messages_->blob(3, message.size);
    if (message.data != nullptr || message.size == 0) return true;
    row = order_->step();
  }
  order_.reset();
  if (row != SqliteQuery::Row::kEnd) goOnInScan("is damaged or cut off");
  return false;
}

/// Goes on in a damaged file; what came before must not come again.
bool Ros2BagReader::nextInScan(BagMessage& message) {
  while (const auto row = scan_->next()) {
    const auto topic = topic_of_id_.find(row->topic_id);
    const bool came = std::pair(row->stamp_ns, row->id) <= last_;
    if (came || row->id <= last_scanned_ || topic == topic_of_id_.end()) continue;
    last_scanned_ = row->id;
    if (!wants(topics_[topic->second].name, row->stamp_ns)) continue;
    message = {topic->second, row->stamp_ns, row->data, row->size};
    return true;
  }
  scan_.reset();
  return false;
}

}  // namespace heel
