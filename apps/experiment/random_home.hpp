// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Homes of all kinds, and a person to follow through one, with others about.
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

struct RandomEpisodeParams {
  double empty_s = 5.2;  ///< Nobody is before the robot for so long.
  int visits = 3;        ///< Rooms that the person goes to.
  int max_others = 2;    ///< Others who walk about.
  double camera_rate_hz = 10.0;
};

/// One home, one person drawn from everybody in a wardrobe, who comes before the robot, is looked
/// at for ten seconds, and then visits rooms at a walking pace of their own, waiting now and then
/// for the robot to come near and going back for it if it does not, as people do; and up to
/// max_others of the wardrobe, who walk about: whoever looks like the person may be one of them.
/// The camera's light is drawn from the run's seed.
/// @param scenes  Folder of the scenes that come with Heel, for the furniture.
/// @throws std::runtime_error  as loadScene().
Scene randomEpisode(std::uint64_t seed, const std::filesystem::path& scenes,
                    const RandomEpisodeParams& params = {});

}  // namespace heel
