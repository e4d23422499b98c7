// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Our MCAP files and ROS 2 messages against npm's @mcap/core and @foxglove/rosmsg2-serialization,
/// where these are installed.

#include "tests/support/data.hpp"
#include "tests/support/filled_message.hpp"
#include "tests/support/temp_folder.hpp"
#include <heel/apps/bag/bag.hpp>

#include <gmock/gmock.h>

#include <cstdlib>

namespace heel {
namespace {

using test::filled;
using test::readText;
using testing::HasSubstr;

/// A message as it lies in a bag.
struct Stored {
  std::string topic, type;
  std::int64_t stamp_ns;
  std::vector<std::uint8_t> bytes;
  bool operator==(const Stored& other) const {
    return topic == other.topic && type == other.type && stamp_ns == other.stamp_ns &&
           bytes == other.bytes;
  }
};

std::vector<Stored> readStored(const std::filesystem::path& path) {
  const auto bag = openBag(path);
  std::vector<Stored> all;
  BagMessage raw;
  while (bag->next(raw)) {
    const BagTopic& topic = bag->topics()[raw.topic];
    all.push_back({topic.name, topic.type, raw.stamp_ns, {raw.data, raw.data + raw.size}});
  }
  EXPECT_EQ(bag->lost(), "");
  return all;
}

/// How the peer writes its copy.
class McapPeer : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (!test::hasNpm("@mcap/core")) GTEST_SKIP() << test::kNoNpm << "@mcap/core";
  }

  /// What the peer prints.
  std::string copy(const std::filesystem::path& from, const std::filesystem::path& to) const {
    const std::string command = "NODE_PATH='" + test::nodeModules() + "' node '" + HEEL_SOURCE_DIR +
                                "/tests/apps/bag/mcap_peer.cjs' '" + from.string() + "' '" +
                                to.string() + "' " + GetParam() + " >'" +
                                (folder_ / "log").string() + "' 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << readText(folder_ / "log");
    return readText(folder_ / "log");
  }

  test::TempFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(Copies, McapPeer, testing::Values("zstd", "none", "chunkless", "bare"),
                         [](const auto& each) { return std::string(each.param); });

template <class... Messages>
void writeAll(BagWriter& bag, std::int64_t& ns) {
  (bag.write(std::string("/") + Messages::kType, ++ns, filled<Messages>()), ...);
}

TEST_P(McapPeer, TakesEveryMessageApartAndItsCopyIsTheSameToUs) {
  const auto bag = createBag(folder_ / "ours.mcap");
  std::int64_t ns = 0;
  for (int i = 0; i < 20; ++i) {
    writeAll<ImageMsg, CompressedImageMsg, CameraInfoMsg, PointCloud2Msg, LaserScanMsg, OdometryMsg,
             PathMsg, OccupancyGridMsg, TFMessageMsg, PoseArrayMsg, PoseStampedMsg, MarkerArrayMsg,
             TwistStampedMsg, StringMsg, DiagnosticArrayMsg>(*bag, ns);
  }
  bag->commit();
  const std::string told = copy(folder_ / "ours.mcap", folder_ / "theirs.mcap");
  const std::string written = std::to_string(ns);  // a message each ns
  EXPECT_THAT(told, HasSubstr(written + " messages, " + written + " by the statistics"));
  EXPECT_THAT(told, HasSubstr("/sensor_msgs/LaserScan sensor_msgs/msg/LaserScan {\"header\":"));
  EXPECT_EQ(readStored(folder_ / "theirs.mcap"), readStored(folder_ / "ours.mcap"));
}

TEST_P(McapPeer, ReadsInTheOrderOfTimeWhatWasWrittenTopicAfterTopic) {
  const auto bag = createBag(folder_ / "ours.mcap");
  LaserScanMsg scan;
  scan.ranges.assign(5000, 1.5F);
  for (const int after : {0, 1}) {
    for (int i = 1; i <= 300; ++i) bag->write(after == 0 ? "/a" : "/b", 10 * i + after, scan);
  }
  bag->commit();
  copy(folder_ / "ours.mcap", folder_ / "theirs.mcap");
  EXPECT_EQ(readStored(folder_ / "theirs.mcap"), readStored(folder_ / "ours.mcap"));
}

}  // namespace
}  // namespace heel
