// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// One of the robot's other programs: says a word to the follower until /diagnostics tells a state,
/// and then looks at what the wheels are told.
///   live_peer ROS DOMAIN WORD STATE moves|stands|ends
/// It ends with 0 if within half a minute the robot moves, or has stood for a second, or the
/// follower tells nothing any more. STATE may be "any": then the word is said until the end, and
/// for three seconds to a robot that stands anyway, or it may not have been heard at all.

#include <heel/apps/live/live_network.hpp>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace heel {
namespace {

int run(const LiveNetworkParams& params, const std::string& word, const std::string& state,
        const std::string& wheels) {
  const auto network = openNetwork(params);
  const auto writer = network->writer();
  writer->announce<StringMsg>("/heel/command");
  network->subscribe({"/diagnostics", DiagnosticArrayMsg::kType, {}}, Delivery::kReliable);
  network->subscribe({"/cmd_vel", TwistMsg::kType, {}}, Delivery::kReliable);
  const double began_s = steadyClock_s();
  const double stands_s = state == "any" ? 3.0 : 1.0;
  double said_s = 0.0, heard_s = began_s + 1.5, stood_s = 0.0;
  bool is_told = false;
  for (double now_s = began_s; now_s < began_s + 30.0; now_s = steadyClock_s()) {
    if (wheels == "ends" && now_s > heard_s + 2.5) return 0;
    if ((!is_told || state == "any") && now_s > said_s + 0.2) {
      writer->write("/heel/command", 0, StringMsg{word});
      said_s = now_s;
    }
    const auto message = network->next(0.1);
    if (!message) continue;
    const auto read = [&](auto& into) {
      readMessage(network->form(), message->bytes.data(), message->bytes.size(), into);
    };
    if (message->topic.holds<DiagnosticArrayMsg>()) {
      DiagnosticArrayMsg diagnostics;
      read(diagnostics);
      heard_s = now_s;
      is_told = is_told || state == "any" || diagnostics.status.at(0).values.at(0).value == state;
    } else if (is_told) {
      TwistMsg twist;
      read(twist);
      const bool stands = twist.linear.x == 0.0 && twist.angular.z == 0.0;
      if (wheels == "moves" && !stands) return 0;
      if (!stands) stood_s = 0.0;
      if (stands && stood_s == 0.0) stood_s = now_s;
      if (wheels == "stands" && stands && now_s > stood_s + stands_s) return 0;
    }
  }
  std::printf("'%s': %s\n", word.c_str(), is_told ? "told, but not obeyed" : "not told");
  return 1;
}

}  // namespace
}  // namespace heel

int main(int argc, char** argv) {
  if (argc != 6) return 2;
  heel::LiveNetworkParams params = heel::rosEnvironment();
  params.ros = std::string(argv[1]) == "1" ? heel::BagForm::kRos1 : heel::BagForm::kRos2;
  params.domain = std::atoi(argv[2]);
  return heel::run(params, argv[3], argv[4], argv[5]);
}
