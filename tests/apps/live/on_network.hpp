// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Tests of the networks that this build has.
#pragma once

#include "tests/support/roscore.hpp"
#include <heel/apps/live/live_network.hpp>

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace heel::test {

/// Those that this build has.
inline std::vector<BagForm> networks() {
  std::vector<BagForm> known;
#ifdef HEEL_HAS_ROS1
  known.push_back(BagForm::kRos1);
#endif
#ifdef HEEL_HAS_ROS2
  known.push_back(BagForm::kRos2);
#endif
  return known;
}

/// A program is one node of ROS 1, and so has one roscore.
inline Roscore& roscore() {
  static Roscore core;
  return core;
}

/// Waits for what comes sooner or later.
template <class Is>
bool waitFor(const Is& is) {
  for (int i = 0; i < 600; ++i) {
    if (is()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return false;
}

template <class Message>
Message decoded(const LiveMessage& message, BagForm form) {
  Message read;
  EXPECT_TRUE(message.topic.holds<Message>()) << message.topic.type << " " << message.topic.md5;
  readMessage(form, message.bytes.data(), message.bytes.size(), read);
  return read;
}

using Program = std::unique_ptr<FILE, int (*)(FILE*)>;

/// What another program prints until it ends, while something is done 20 times a second.
inline std::string saidMeanwhile(FILE* program, const std::function<void()>& act) {
  std::atomic<bool> is_said{false};
  std::thread acting([&] {
    while (!is_said) {
      act();
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  });
  std::string said;
  for (int c = fgetc(program); c != EOF; c = fgetc(program)) {
    said += static_cast<char>(c);
  }
  is_said = true;
  acting.join();
  return said;
}

class OnNetwork : public testing::Test {
 protected:
  explicit OnNetwork(BagForm ros) : ros_(ros) {}
  void SetUp() override {
    if (ros_ != BagForm::kRos1) return;
    if (!Roscore::isInstalled()) GTEST_SKIP() << "roscore is not installed (python3-roslaunch)";
    roscore();
  }

  /// Of this machine only, and of this test only.
  std::unique_ptr<LiveNetwork> open(const std::string& ros_namespace = {}) const {
    LiveNetworkParams params;
    params.ros = ros_;
    params.ros_namespace = ros_namespace;
    params.domain = 1 + static_cast<int>(getpid() % 200);
    params.localhost_only = true;
    return openNetwork(params);
  }

  BagForm ros_;
};

class EachNetwork : public OnNetwork, public testing::WithParamInterface<BagForm> {
 protected:
  EachNetwork() : OnNetwork(GetParam()) {}
};

inline std::string networkName(const testing::TestParamInfo<BagForm>& tested) {
  return tested.param == BagForm::kRos1 ? "Ros1" : "Ros2";
}

}  // namespace heel::test
