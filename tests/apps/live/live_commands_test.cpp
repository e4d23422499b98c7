// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/apps/live/on_network.hpp"
#include <heel/apps/live/live_commands.hpp>

#include <gmock/gmock.h>

#include <mutex>

namespace heel {
namespace {

class LiveCommandsTest : public test::EachNetwork {
 protected:
  void SetUp() override {
    test::EachNetwork::SetUp();
    if (IsSkipped()) return;
    robot_ = open();
    writer_ = robot_->writer();
    commands_ =
        std::make_unique<LiveCommands>(open(), [this](const std::string& words, bool not_known) {
          const std::lock_guard<std::mutex> lock(mutex_);
          (not_known ? unknown_ : known_).push_back(words);
        });
  }

  /// Says it again and again: at first nobody may listen yet.
  template <class Message>
  bool say(const Message& message, const std::function<bool()>& is_heard) {
    return test::waitFor([&] {
      writer_->write("/heel/command", 0, message);
      return is_heard();
    });
  }
  std::vector<std::string> unknown() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return unknown_;
  }

  std::mutex mutex_;
  std::vector<std::string> known_, unknown_;
  std::unique_ptr<LiveNetwork> robot_;
  std::unique_ptr<BagWriter> writer_;
  std::unique_ptr<LiveCommands> commands_;
};

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(LiveCommandsTest);
INSTANTIATE_TEST_SUITE_P(Live, LiveCommandsTest, testing::ValuesIn(test::networks()),
                         test::networkName);

TEST_P(LiveCommandsTest, PauseHoldsUntilGo) {
  EXPECT_FALSE(commands_->mustStand());
  ASSERT_TRUE(say(StringMsg{"pause"}, [&] { return commands_->isPaused(); }));
  EXPECT_TRUE(commands_->mustStand());
  ASSERT_TRUE(say(StringMsg{"go"}, [&] { return !commands_->isPaused(); }));
  EXPECT_FALSE(commands_->mustStand());
}

TEST_P(LiveCommandsTest, TheRobotStandsUntilItHasForgotten) {
  ASSERT_TRUE(say(StringMsg{"forget"}, [&] { return commands_->mustForget(); }));
  EXPECT_TRUE(commands_->mustStand());
  EXPECT_FALSE(commands_->isPaused());
  ASSERT_TRUE(test::waitFor([&] {  // What was said often is heard often.
    commands_->hasForgotten();
    return !commands_->mustStand();
  }));
}

TEST_P(LiveCommandsTest, StopIsForGood) {
  ASSERT_TRUE(say(StringMsg{"stop"}, [&] { return commands_->isStopped(); }));
  ASSERT_TRUE(say(StringMsg{"go"}, [&] {
    const std::lock_guard<std::mutex> lock(mutex_);
    return known_.back() == "go";
  }));
  EXPECT_TRUE(commands_->isStopped());
  EXPECT_TRUE(commands_->mustStand());
}

TEST_P(LiveCommandsTest, WordsThatAreNotKnownChangeNothingAndAreToldOnce) {
  ASSERT_TRUE(say(StringMsg{"pause"}, [&] { return commands_->isPaused(); }));
  ASSERT_TRUE(say(StringMsg{"da\nce"}, [&] { return !unknown().empty(); }));
  ASSERT_TRUE(say(StringMsg{"Go"}, [&] { return unknown().size() > 1; }));
  EXPECT_THAT(unknown(), testing::ElementsAre("da?ce", "Go"));
  EXPECT_TRUE(commands_->isPaused());
}

}  // namespace
}  // namespace heel
