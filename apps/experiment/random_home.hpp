// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Homes of all kinds, to follow a person through.
#pragma once

#include <heel/apps/simulation/scene.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace heel {

/// A room's rectangle, between the middle lines of its walls.
struct Room {
  std::string name;
  Eigen::Vector2d low;
  Eigen::Vector2d high;
};

/// A home, ready to live in; the robot stands in the first room and looks along it.
struct RandomHome {
  Scene scene;              ///< Without people.
  std::vector<Room> rooms;  ///< The first is the living room; the last is the hall.
};

/// A flat of five rooms along a hall. Sizes, doorways, furniture, colours and lights are drawn;
/// some of the furniture is not in the robot's map. Every room can be reached by a robot, and there
/// is room before it for a person to be learned.
/// @param models  The file of furniture models.
/// @throws std::runtime_error  as loadScene().
RandomHome randomHome(std::uint64_t seed, const std::filesystem::path& models);

}  // namespace heel
