// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/live/live_commands.hpp>

#include <stdexcept>
#include <utility>

namespace heel {

LiveCommands::LiveCommands(std::unique_ptr<LiveNetwork> network, Told told)
    : network_(std::move(network)), told_(std::move(told)) {
  network_->subscribe({"/heel/command", StringMsg::kType, {}}, Delivery::kReliable);
  thread_ = std::thread([this] { listen(); });
}

LiveCommands::~LiveCommands() {
  ends_ = true;
  thread_.join();
}

void LiveCommands::listen() {
  try {
    while (!ends_) {
      if (const auto message = network_->next(0.1)) obey(*message);
    }
  } catch (const std::exception&) {
    is_paused_ = true;  // The network has shut us out; the control loop is told that, too.
  }
}

void LiveCommands::obey(const LiveMessage& message) {
  StringMsg words;
  try {
    if (!message.topic.holds<StringMsg>()) throw std::runtime_error("another type");
    readMessage(network_->form(), message.bytes.data(), message.bytes.size(), words);
  } catch (const std::runtime_error&) {
    words.data = "(no std_msgs/String)";
  }
  const std::string& word = words.data;
  const bool is_known = word == "pause" || word == "go" || word == "forget" || word == "stop";
  if (word == "pause") is_paused_ = true;
  if (word == "go") is_paused_ = false;
  if (word == "forget") forgets_ = true;
  if (word == "stop") is_stopped_ = true;
  if (!is_known && std::exchange(unknown_, word) == word) return;  // One line for it is enough.
  constexpr std::size_t kMostShown = 40;
  told_(printable(word.substr(0, kMostShown)), !is_known);
}

}  // namespace heel
