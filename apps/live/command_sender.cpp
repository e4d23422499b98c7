// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/live/command_sender.hpp>
#include <heel/apps/live/live_network.hpp>
#include <heel/apps/recording/bags/bag_poses.hpp>

#include <chrono>
#include <exception>
#include <utility>

namespace heel {

CommandSender::CommandSender(std::unique_ptr<BagWriter> writer, CommandSenderParams params)
    : params_(std::move(params)), writer_(std::move(writer)) {
  send({}, stampNow_s());  // Whether it can be sent is seen here, and not in the thread.
  thread_ = std::thread([this] { run(); });
}

CommandSender::~CommandSender() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ends_ = true;
  }
  wakes_.notify_one();
  thread_.join();
  constexpr int kZeros = 5;  // one may be lost
  try {
    for (int i = 0; i < kZeros; ++i) {
      send({}, stampNow_s());
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  } catch (const std::exception&) {
    // There is no way to the robot any more.
  }
}

void CommandSender::set(const VelocityCommand& command, double stamp_s) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    command_ = command;
    stamp_s_ = stamp_s;
    set_s_ = steadyClock_s();
    is_new_ = true;
  }
  wakes_.notify_one();
}

std::size_t CommandSender::stopped() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return stopped_;
}

double CommandSender::stampNow_s() const {
  if (set_s_ > 0.0) return stamp_s_ + (steadyClock_s() - set_s_);
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

void CommandSender::send(const VelocityCommand& command, double stamp_s) {
  TwistStampedMsg message;
  message.header.stamp.ns = nanosecondsOf(stamp_s);
  message.header.frame_id = "base_link";
  message.twist.linear.x = command.forward_mps;
  message.twist.angular.z = command.turn_radps;
  if (params_.stamped) {
    writer_->write(params_.topic, 0, message);
  } else {
    writer_->write(params_.topic, 0, message.twist);
  }
}

void CommandSender::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!ends_) {
    const bool is_fresh = set_s_ > 0.0 && steadyClock_s() - set_s_ <= params_.timeout_s;
    if (is_fresh_ && !is_fresh) ++stopped_;
    is_fresh_ = is_fresh;
    const bool may_drive = is_fresh && !params_.must_stand();
    const VelocityCommand command = may_drive ? command_ : VelocityCommand{};
    const double stamp_s = stampNow_s();
    is_new_ = false;
    lock.unlock();
    send(command, stamp_s);
    lock.lock();
    wakes_.wait_for(lock, std::chrono::duration<double>(1.0 / params_.rate_hz),
                    [this] { return ends_ || is_new_; });
  }
}

}  // namespace heel
