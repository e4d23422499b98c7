// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Bags: the logs of ROS robots, read as a stream. No ROS is needed.
#pragma once

#include <heel/apps/bag/message_archives.hpp>
#include <heel/apps/bag/message_definition.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace heel {

/// A stream of messages of one type.
struct BagTopic {
  std::string name;
  std::string type;  ///< In ROS 1's way for both forms: "sensor_msgs/Image".
  std::string md5;   ///< Of the type's definition; empty in ROS 2.

  /// Whether its messages are of our `Message`, in the version that we know.
  template <class Message>
  bool holds() const {
    // tf's own older type has the same fields.
    const bool same_type =
        type == Message::kType || (type == "tf/tfMessage" && TFMessageMsg::kType == Message::kType);
    return same_type && (md5.empty() || md5 == "*" || md5 == Message::kMd5);
  }
};

/// A message as it lies in a bag.
struct BagMessage {
  std::size_t topic = 0;               ///< Index into topics().
  std::int64_t stamp_ns = 0;           ///< When it was recorded.
  const std::uint8_t* data = nullptr;  ///< Valid until the next one is read.
  std::size_t size = 0;
};

/// Which messages of a bag are read; all if nothing is said.
struct BagQuery {
  std::vector<std::string> topics = {};  ///< Their names; none: all.
  /// When they were recorded; both ends are read.
  std::int64_t from_ns = std::numeric_limits<std::int64_t>::min();
  std::int64_t to_ns = std::numeric_limits<std::int64_t>::max();
};

/// What a bag's index tells of its messages.
struct BagIndex {
  struct Topic {
    std::size_t count = 0;
    std::int64_t first_ns = 0, last_ns = 0;  ///< When the first and last were recorded.
  };
  std::int64_t first_ns = 0, last_ns = 0;
  std::vector<Topic> topics;  ///< As BagReader::topics().
};

/// A bag, whose index alone is read when it is opened; then the chunks or rows that have messages
/// that are wanted. Chunks that overlap in time are held in memory together, within a limit.
///
/// A bag that was cut off, or whose index is damaged, is read without it, from its beginning to its
/// end. What is damaged or missing is left out, and lost() says so.
class BagReader {
 public:
  virtual ~BagReader() = default;

  virtual BagForm form() const = 0;

  /// The topics: all of them if there is an index, else those that have been met so far.
  const std::vector<BagTopic>& topics() const { return topics_; }

  /// Null if the bag has none that holds.
  virtual const BagIndex* index() = 0;

  /// Chooses what next() reads, and begins again.
  virtual void select(const BagQuery& query) = 0;

  /// Reads the next message in the order of time; without an index, in that of the file. False at
  /// the end.
  virtual bool next(BagMessage& message) = 0;

  /// What of the bag could not be read so far, in one sentence that names it; empty: nothing.
  const std::string& lost() const { return lost_; }

  /// @throws std::runtime_error  with half a sentence, if the message is broken.
  template <class Message>
  void read(const BagMessage& raw, Message& message) const {
    readMessage(form(), raw.data, raw.size, message);
  }

 protected:
  bool wants(const std::string& topic) const;
  bool wants(const std::string& topic, std::int64_t stamp_ns) const {
    return stamp_ns >= query_.from_ns && stamp_ns <= query_.to_ns && wants(topic);
  }

  std::vector<BagTopic> topics_;
  std::string lost_;
  BagQuery query_;
};

/// A name of a bag that may be damaged: '?' for whatever is no printable ASCII.
std::string printable(std::string_view name);

/// Whether `path` is named like a bag: X.bag (ROS 1), X.db3, X.mcap, or a folder with a
/// metadata.yaml, a .db3 or a .mcap in it (ROS 2), or with nothing to read but X.bag (ROS 1,
/// split).
bool isBag(const std::filesystem::path& path);

/// @throws std::runtime_error  one sentence that names the file, if it is no bag or can't be read.
std::unique_ptr<BagReader> openBag(const std::filesystem::path& path);

/// Writes a bag; it gets its name only when it is complete.
class BagWriter {
 public:
  virtual ~BagWriter() = default;

  virtual BagForm form() const = 0;

  /// Makes a topic of a network known before its first message.
  /// @throws std::runtime_error  as write().
  template <class Message>
  void announce(const std::string& topic, bool latched = false) {
    topicNamed<Message>(topic, latched);
  }

  /// @param latched  Whoever comes late shall get the last message, too.
  /// @throws std::runtime_error  if it can't be written, for instance when the disk is full.
  template <class Message>
  void write(const std::string& topic, std::int64_t stamp_ns, const Message& message,
             bool latched = false) {
    writeMessage(form(), message, bytes_);
    put(topicNamed<Message>(topic, latched), stamp_ns, bytes_);
  }

  /// Whether somebody hears what is written on a topic that was made known: of a bag, always.
  bool isHeard(const std::string& topic) const {
    for (std::size_t i = 0; i < topics_.size(); ++i) {
      if (topics_[i].name == topic) return isHeard(i);
    }
    return false;
  }

  /// Completes the bag and gives it its name, in the place of one that has it.
  /// @param complete  False if more was to come: then it does not replace one that is complete.
  /// @throws std::runtime_error  as write().
  virtual void commit(bool complete = true) = 0;

 protected:
  struct Topic {
    std::string name, type, md5, definition;
    bool latched = false;
  };
  std::vector<Topic> topics_;

 private:
  virtual void put(std::size_t topic, std::int64_t stamp_ns,
                   const std::vector<std::uint8_t>& bytes) = 0;
  /// Told of each topic before its first message.
  virtual void add(std::size_t topic) = 0;
  virtual bool isHeard(std::size_t /*topic*/) const { return true; }

  template <class Message>
  std::size_t topicNamed(const std::string& name, bool latched) {
    for (std::size_t i = 0; i < topics_.size(); ++i) {
      if (topics_[i].name == name) return i;
    }
    topics_.push_back(
        {name, Message::kType, Message::kMd5, definitionOf<Message>(form()), latched});
    add(topics_.size() - 1);
    return topics_.size() - 1;
  }

  std::vector<std::uint8_t> bytes_;
};

/// Where a bag goes, and what it may not replace.
struct BagPlan {
  std::filesystem::path path;
  std::vector<std::filesystem::path> inputs = {};  ///< What is read while it is written.
  std::string by = "bag";  ///< Who writes: a bag of that name is replaced only if they made it.
};

/// Begins a bag: `X.bag` in ROS 1's form, `X.mcap` and `X.db3` as the one file of ROS 2's, any
/// other name as ROS 2's folder (metadata.yaml and a .db3).
/// @throws std::invalid_argument  if it may not go there, see Output.
/// @throws std::runtime_error  if it can't be made.
std::unique_ptr<BagWriter> createBag(const BagPlan& plan);
inline std::unique_ptr<BagWriter> createBag(const std::filesystem::path& path) {
  return createBag(BagPlan{path});
}

}  // namespace heel
