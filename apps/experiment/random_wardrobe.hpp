// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Five people with clothes, and the scenes in which they are learned and looked for.
#pragma once

#include <heel/apps/simulation/scene.hpp>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace heel {

/// People whose tops are of one colour each; the first two wear tops of nearly the same.
struct Wardrobe {
  std::uint64_t seed = 0;
  std::vector<ScenePerson> people;  ///< Without place and path.
};

/// The place of the person whose top is like the first one's.
constexpr std::size_t kLikeTheFirst = 1;

/// Clothes like those of a laboratory: black and charcoal for the similar pair, then navy, crimson
/// and white.
Wardrobe laboratoryWardrobe();

/// Tops of four colours drawn from twenty; the second person's is the first's, a little lighter or
/// darker and a little off in hue. Trousers, hair, skin and size are drawn for each by themselves,
/// so the similar pair may wear the same trousers too.
Wardrobe randomWardrobe(std::uint64_t seed);

/// The rooms of the experiment: two furnished rooms with other floors, walls and furniture, whose
/// colours and lights change with the wardrobe's seed.
class WardrobeRooms {
 public:
  /// @param scenes  Folder that holds wardrobe.yaml and pair.yaml.
  /// @param drawn_light  See CameraParams; every recording has another.
  /// @throws std::runtime_error  as loadScene().
  WardrobeRooms(const std::filesystem::path& scenes, std::uint64_t seed, bool drawn_light = false);

  /// Phase 1: the room is empty for `empty_s`, then the person comes in and walks about, turning to
  /// all sides.
  Scene acquisition(const ScenePerson& person, double empty_s, std::uint64_t seed) const;

  /// Other place, light, way and time: `people` come in and walk about before the robot.
  Scene trial(const std::vector<ScenePerson>& people, std::uint64_t seed) const;

 private:
  Scene learning_room_, trial_room_;
};

}  // namespace heel
