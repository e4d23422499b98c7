// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/live/find_robot.hpp>
#include <heel/apps/live/live_simulation.hpp>
#include <heel/apps/output/run_end.hpp>
#include <heel/apps/recording/bags/bag_map.hpp>
#include <heel/apps/simulation/scene_map.hpp>
#include <heel/apps/simulation/simulate.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace heel {

LiveSimulationResult runLiveSimulation(const Scene& scene, const LiveSimulationParams& params,
                                       LiveNetwork& network) {
  constexpr double kTen_s = 10.0;
  const BagTopic cmd_vel{"/cmd_vel", TwistMsg::kType, {}};
  SimulatorOptions options;
  options.seed = params.seed;
  options.threads = params.threads;
  Simulator simulator(scene, options);
  SensorBag bag = sensorBag(network.writer(), simulator, false);
  const std::unique_ptr<BagWriter> map_server = network.writer();
  OccupancyGridMsg map = toMessage(laserGrid(scene));
  map.header.frame_id = "map";
  map_server->write("/map", 0, map, true);
  network.subscribe(cmd_vel, Delivery::kAsSent, 1);
  LiveSimulationResult result;
  const double step_s = stepFor(scene.robot);
  VelocityCommand command;
  double commanded_s = 0.0;  // on the steady clock
  bool was_contact = false;
  FloorPose before;
  double wake_s = steadyClock_s(), ten_s = wake_s, ten_stamp_s = 0.0;
  for (long i = 0;; ++i) {
    const Readings& readings = simulator.step(i == 0 ? 0.0 : step_s, command);
    addTo(bag, readings);
    const WorldTruth& truth = readings.truth;
    if (truth.contact && !was_contact) {
      ++result.contacts;
      if (truth.contact_by_robot) ++result.contacts_by_robot;
    }
    was_contact = truth.contact;
    if (i > 0) result.way_m += (truth.robot.position - before.position).norm();
    before = truth.robot;
    result.duration_s = readings.stamp_s;
    if (!truth.people.empty()) {
      result.person_distance_m = (truth.people.front().position - truth.robot.position).norm();
    }
    if (params.progress) params.progress(truth, readings.stamp_s);
    if (readings.stamp_s - ten_stamp_s >= kTen_s) {
      const double now_s = steadyClock_s();
      result.slowest = std::max(result.slowest, (now_s - ten_s) / kTen_s);
      ten_s = now_s;
      ten_stamp_s = readings.stamp_s;
    }
    if (readings.stamp_s >= params.duration_s || isStopRequested()) break;
    // A machine that can't keep up makes time slow, not jump.
    wake_s = std::max(wake_s + step_s / params.speed, steadyClock_s() - step_s);
    for (double left_s = 1.0; left_s > 0.0;) {
      left_s = wake_s - steadyClock_s();
      const auto message = network.next(std::max(left_s, 0.0));
      if (!message || !message->topic.holds<TwistMsg>()) continue;
      TwistMsg twist;
      try {
        readMessage(network.form(), message->bytes.data(), message->bytes.size(), twist);
      } catch (const std::runtime_error&) {
        continue;
      }
      if (!std::isfinite(twist.linear.x) || !std::isfinite(twist.angular.z)) continue;
      command = {twist.linear.x, twist.angular.z};
      commanded_s = steadyClock_s();
      ++result.commands;
    }
    if (steadyClock_s() - commanded_s > params.command_timeout_s) command = {};
  }
  result.everyone_is_done = simulator.everyoneIsDone();
  return result;
}

}  // namespace heel
