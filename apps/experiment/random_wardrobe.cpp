// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/random_wardrobe.hpp>
#include <heel/apps/simulation/random.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

namespace heel {
namespace {

using Eigen::Vector2d;

constexpr std::array<const char*, 5> kNames = {"anna", "bruno", "carla", "dario", "elsa"};
constexpr std::array<const char*, 20> kTops = {
    "black",  "navy",  "crimson", "white", "forest",   "mustard", "sky",
    "purple", "grey",  "rust",    "teal",  "olive",    "pink",    "burgundy",
    "blue",   "beige", "plum",    "green", "lavender", "charcoal"};
constexpr std::array<const char*, 8> kTrousers = {"denim", "black", "charcoal", "khaki",
                                                  "navy",  "brown", "grey",     "sand"};
constexpr std::array<const char*, 5> kHair = {"black", "chestnut", "brown", "ginger", "sand"};
constexpr std::array<const char*, 3> kSkin = {"skin_light", "skin_tan", "skin_dark"};
constexpr std::array<const char*, 6> kWalls = {"cream", "white", "beige", "sand", "silver", "mint"};
constexpr std::array<const char*, 8> kFabrics = {"teal", "mustard", "slate",    "rust",
                                                 "navy", "olive",   "burgundy", "charcoal"};

Rgb colorOf(const char* name) { return *parseColor(name); }

template <std::size_t N>
const char* pick(const std::array<const char*, N>& names, RandomStream& random) {
  return names[static_cast<std::size_t>(random.uniform() * static_cast<double>(N))];
}

/// A person of a random build, in trousers, hair and skin of their own.
ScenePerson randomPerson(std::size_t number, RandomStream& random) {
  ScenePerson person;
  person.name = kNames[number];
  person.height_m = random.uniform(1.62, 1.88);
  person.build = random.uniform(0.94, 1.1);
  person.outfit.trousers.front.color = colorOf(pick(kTrousers, random));
  person.outfit.hair = colorOf(pick(kHair, random));
  person.outfit.skin = colorOf(pick(kSkin, random));
  person.outfit.long_hair = random.uniform() < 0.4;
  return person;
}

/// Another dye of the same colour: up to 15 % lighter or darker on a display, each channel off by
/// up to 4 %.
Rgb nearlyTheSame(const Rgb& color, RandomStream& random) {
  const double light = random.uniform(0.85, 1.15);
  Rgb result;
  for (int c = 0; c < 3; ++c) {
    const double display = toDisplay(color[c]) * light * random.uniform(0.96, 1.04);
    result[c] = toLinear(static_cast<float>(std::clamp(display, 0.0, 1.0)));
  }
  return result;
}

/// The same room in other paint and light.
void redecorate(Scene& room, RandomStream& random) {
  const Rgb wall = colorOf(pick(kWalls, random));
  for (Wall& w : room.walls) {
    for (Surface* side : {&w.left, &w.right}) {
      if (side->material == "plaster" || side->material == "roughcast") side->color = wall;
    }
  }
  for (Furniture& furniture : room.furniture) {
    const Rgb fabric = colorOf(pick(kFabrics, random));
    for (FurniturePart& part : furniture.parts) {
      if (part.surface.material == "fabric") part.surface.color = fabric;
    }
  }
  for (Light& light : room.lights) {
    light.power *= random.uniform(0.8, 1.25);
    const auto warmth = static_cast<float>(random.uniform(-0.06, 0.06));
    light.color *= Rgb(1.0F + warmth, 1.0F, 1.0F - warmth);
  }
}

PathStep walkTo(const Vector2d& to, double speed_mps) {
  PathStep step;
  step.kind = PathStep::Kind::kWalk;
  step.to = to;
  step.speed_mps = speed_mps;
  return step;
}

/// In from beside the robot, where it does not look, then about before it for ever. Places are in
/// the robot's frame.
void comeIn(ScenePerson& person, double side, double after_s, RandomStream& random,
            const RobotParams& robot) {
  const Eigen::Rotation2Dd turn(robot.start_yaw_rad);
  const auto place = [&](double x, double y) -> Vector2d {
    return robot.start + turn * Vector2d(x, y);
  };
  person.start = place(0.45, 1.6 * side);
  person.start_yaw_rad = robot.start_yaw_rad;
  person.path.clear();
  PathStep wait;
  wait.wait_s = after_s;
  person.path.push_back(wait);
  const double speed_mps = random.uniform(0.75, 1.05);
  person.path.push_back(walkTo(place(2.0, 0.5 * side), speed_mps));
  for (int i = 0; i < 12; ++i) {
    const double x = random.uniform(1.9, 4.2);
    const double reach = std::min(0.95, 0.42 * x);
    person.path.push_back(walkTo(place(x, random.uniform(-reach, reach)), speed_mps));
  }
  person.repeat = false;
}

/// A camera that is quick to render and coarse, as the paper's was.
void useSmallCamera(Scene& room) {
  room.robot.camera.width = 320;
  room.robot.camera.height = 240;
  room.robot.camera.rate_hz = 5.0;
}

}  // namespace

Wardrobe laboratoryWardrobe() {
  Wardrobe wardrobe;
  RandomStream random(hashOf(0, 10));
  constexpr std::array<const char*, 5> kLaboratory = {"black", "charcoal", "navy", "crimson",
                                                      "white"};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    wardrobe.people.push_back(randomPerson(i, random));
    wardrobe.people.back().outfit.top.front.color = colorOf(kLaboratory[i]);
  }
  return wardrobe;
}

Wardrobe randomWardrobe(std::uint64_t seed) {
  Wardrobe wardrobe;
  wardrobe.seed = seed;
  RandomStream random(hashOf(seed, 11));
  auto tops = kTops;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    ScenePerson person = randomPerson(i, random);
    if (i == 1) {
      person.outfit.top.front.color =
          nearlyTheSame(wardrobe.people[0].outfit.top.front.color, random);
    } else {
      const auto left = static_cast<double>(tops.size() - i);  // Drawn tops go to the end.
      const auto drawn = static_cast<std::size_t>(random.uniform() * left);
      person.outfit.top.front.color = colorOf(tops[drawn]);
      std::swap(tops[drawn], tops[tops.size() - 1 - i]);
    }
    wardrobe.people.push_back(std::move(person));
  }
  return wardrobe;
}

WardrobeRooms::WardrobeRooms(const std::filesystem::path& scenes, std::uint64_t seed,
                             bool drawn_light)
    : learning_room_(loadScene((scenes / "wardrobe.yaml").string())),
      trial_room_(loadScene((scenes / "pair.yaml").string())) {
  RandomStream random(hashOf(seed, 12));
  for (Scene* room : {&learning_room_, &trial_room_}) {
    redecorate(*room, random);
    useSmallCamera(*room);
    room->robot.camera.drawn_light = drawn_light;
    room->people.clear();
  }
}

Scene WardrobeRooms::acquisition(const ScenePerson& person, double empty_s,
                                 std::uint64_t seed) const {
  Scene scene = learning_room_;
  RandomStream random(hashOf(seed, 13));
  scene.people.push_back(person);
  comeIn(scene.people.back(), 1.0, empty_s, random, scene.robot);
  return scene;
}

Scene WardrobeRooms::trial(const std::vector<ScenePerson>& people, std::uint64_t seed) const {
  Scene scene = trial_room_;
  RandomStream random(hashOf(seed, 14));
  scene.robot.start.y() += random.uniform(-0.3, 0.3);
  scene.robot.start_yaw_rad += random.uniform(-0.1, 0.1);
  double side = random.uniform() < 0.5 ? 1.0 : -1.0;
  for (const ScenePerson& person : people) {
    scene.people.push_back(person);
    comeIn(scene.people.back(), side, 0.0, random, scene.robot);
    side = -side;
  }
  return scene;
}

}  // namespace heel
