// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/bags/bag_map.hpp>
#include <heel/apps/recording/bags/bag_poses.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace heel {

OccupancyGridMsg toMessage(const OccupancyGrid& map) {
  OccupancyGridMsg message;
  message.info.resolution = static_cast<float>(map.cell_size_m());
  message.info.width = static_cast<std::uint32_t>(map.width());
  message.info.height = static_cast<std::uint32_t>(map.height());
  setPoint(message.info.origin.position, {map.origin_m().x(), map.origin_m().y(), 0.0});
  message.data.reserve(map.cells().size());
  for (const Occupancy cell : map.cells()) {
    message.data.push_back(cell == Occupancy::kFree       ? std::int8_t{0}
                           : cell == Occupancy::kOccupied ? std::int8_t{100}
                                                          : std::int8_t{-1});
  }
  return message;
}

OccupancyGrid toGrid(const OccupancyGridMsg& message) {
  constexpr std::int8_t kOccupied = 65, kFree = 19;  // map_server's thresholds, in percent
  const MapMetaDataMsg& info = message.info;
  const auto cells = std::uint64_t{info.width} * info.height;
  if (cells == 0 || cells != message.data.size() ||
      cells > static_cast<std::uint64_t>(std::numeric_limits<int>::max())) {
    throw std::runtime_error("a map of " + std::to_string(info.width) + "x" +
                             std::to_string(info.height) + " cells has " +
                             std::to_string(message.data.size()) + " values");
  }
  const double cell_m = std::stod(std::to_string(info.resolution));  // 0.05, not 0.0500000007
  const FloorPose origin = floorPoseOf(info.origin);
  if (!isCellSize(cell_m) || !origin.position.allFinite()) {
    throw std::runtime_error("the map's resolution or origin is out of range");
  }
  if (!(std::abs(origin.yaw_rad) < 1e-6)) throw std::runtime_error("the map is turned");
  OccupancyGrid grid(origin.position, cell_m, static_cast<int>(info.width),
                     static_cast<int>(info.height), Occupancy::kUnknown);
  std::size_t i = 0;
  for (int y = 0; y < grid.height(); ++y) {
    for (int x = 0; x < grid.width(); ++x, ++i) {
      const std::int8_t value = message.data[i];
      if (value >= kOccupied) grid.at({x, y}) = Occupancy::kOccupied;
      if (value >= 0 && value <= kFree) grid.at({x, y}) = Occupancy::kFree;
    }
  }
  return grid;
}

}  // namespace heel
