// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/bags/bag_laser_log.hpp>
#include <heel/apps/recording/carmen_log.hpp>
#include <heel/apps/recording/folders/simulated_laser_log.hpp>
#include <heel/apps/recording/laser_log.hpp>

#include <stdexcept>

namespace heel {

std::unique_ptr<LaserLog> openLaserLog(const std::filesystem::path& path, const BagTopics& topics) {
  if (!std::filesystem::exists(path)) throw std::runtime_error(path.string() + ": does not exist");
  if (isBag(path)) return std::make_unique<BagLaserLog>(path, topics);
  if (!std::filesystem::is_directory(path)) return std::make_unique<CarmenLog>(path);
  if (!std::filesystem::exists(path / "scan.csv")) {
    throw std::runtime_error(path.string() + ": has no laser scans (scan.csv)");
  }
  return std::make_unique<SimulatedLaserLog>(path);
}

}  // namespace heel
