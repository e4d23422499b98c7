// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/folders/simulated_laser_log.hpp>
#include <heel/cloud/files.hpp>

#include <charconv>
#include <limits>
#include <stdexcept>

namespace heel {

void SimulatedLaserLog::Table::open(const std::filesystem::path& file, const std::string& header) {
  name = file.string();
  checkIsFile(file);
  in.open(file);
  if (!in) throw std::runtime_error(name + ": can't be read");
  if (!std::getline(in, line)) throw std::runtime_error(name + ": the file is empty");
  if (line.rfind(header, 0) != 0) {
    throw std::runtime_error(name + ":1: does not begin with '" + header + "'");
  }
}

bool SimulatedLaserLog::Table::next(std::size_t least) {
  if (!std::getline(in, line)) return false;
  ++line_number;
  values.clear();
  const char* at = line.data();
  const char* end = line.data() + line.size();
  while (at < end) {
    double value = 0.0;
    const auto [after, error] = std::from_chars(at, end, value);  // It knows "inf" and "nan", too.
    if (error != std::errc() || (after != end && *after != ',')) {
      throw std::runtime_error(name + ":" + std::to_string(line_number) + ": a number is broken");
    }
    values.push_back(value);
    at = after + 1;
  }
  if (values.size() < least) {
    throw std::runtime_error(name + ":" + std::to_string(line_number) + ": numbers are missing");
  }
  return true;
}

void SimulatedLaserLog::Poses::open(const std::filesystem::path& file, const std::string& header) {
  table.open(file, header);
  read();
  now = next;
}

void SimulatedLaserLog::Poses::read() {
  more = table.next(4);
  if (!more) return;
  next_s = table.values[0];
  next = {{table.values[1], table.values[2]}, table.values[3]};
}

const FloorPose& SimulatedLaserLog::Poses::at(double stamp_s) {
  while (more && next_s <= stamp_s + 1e-6) {
    now = next;
    read();
  }
  return now;
}

SimulatedLaserLog::SimulatedLaserLog(const std::filesystem::path& folder) {
  scans_.open(folder / "scan.csv", "stamp_s,first_rad,step_rad,ranges_m");
  odometry_.open(folder / "odometry.csv", "stamp_s,x_m,y_m,yaw_rad");
  const std::filesystem::path truth = folder / "robot.csv";
  if (std::filesystem::exists(truth)) {
    robot_ = std::make_unique<Poses>();
    robot_->open(truth, "stamp_s,x_m,y_m,yaw_rad");
  }
}

bool SimulatedLaserLog::next(LaserReading& reading) {
  if (!scans_.next(4)) return false;
  reading.stamp_s = scans_.values[0];
  reading.scan.first_rad = scans_.values[1];
  reading.scan.step_rad = scans_.values[2];
  reading.scan.ranges_m.assign(scans_.values.begin() + 3, scans_.values.end());
  reading.odometry = odometry_.at(reading.stamp_s);
  if (robot_) reading.reference = robot_->at(reading.stamp_s);
  return true;
}

}  // namespace heel
