// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/simulation/floor_plan.hpp>
#include <heel/apps/simulation/scene_parts.hpp>

namespace heel {

Rgb readColor(YamlMap& map, const std::string& key, const Rgb& fallback) {
  if (!map.has(key)) return fallback;
  const std::string text = map.text(key);
  const auto color = parseColor(text);
  if (!color) {
    map.fail(key, "is '" + text + "', but must be \"#rrggbb\" or one of " + colorNames());
  }
  return *color;
}

namespace {

Cloth readCloth(YamlMap& map, const Cloth& fallback) {
  Cloth cloth = fallback;
  cloth.color = readColor(map, "color", cloth.color);
  cloth.second = readColor(map, "second", cloth.second);
  cloth.pattern = static_cast<Cloth::Pattern>(
      map.choice("pattern", {"plain", "stripes", "checks"}, static_cast<int>(cloth.pattern)));
  cloth.width_m = map.number("width_m", cloth.width_m, kPositive);
  return cloth;
}

Garment readGarment(YamlMap& outfit, const std::string& key, const Garment& fallback) {
  auto map = outfit.map(key, key);
  if (!map) return fallback;
  Garment garment;
  garment.front = readCloth(*map, fallback.front);
  if (auto back = map->map("back", "back of the " + key)) {
    garment.back = readCloth(*back, garment.front);
    back->done();
  }
  map->done();
  return garment;
}

Outfit readOutfit(YamlMap& map) {
  Outfit outfit;
  outfit.trousers.front.color = Rgb(0.03F, 0.04F, 0.07F);
  outfit.top = readGarment(map, "top", outfit.top);
  outfit.trousers = readGarment(map, "trousers", outfit.trousers);
  outfit.long_sleeves = map.choice("sleeves", {"short", "long"}, 1) == 1;
  outfit.long_hair = map.choice("hair_length", {"short", "long"}, 0) == 1;
  outfit.skirt = map.flag("skirt", false);
  outfit.shoes = readColor(map, "shoes", outfit.shoes);
  outfit.hair = readColor(map, "hair", outfit.hair);
  outfit.skin = readColor(map, "skin", outfit.skin);
  map.done();
  return outfit;
}

PathStep readStep(YamlMap& map, double speed_mps) {
  PathStep step;
  if (map.has("to")) {
    step.kind = PathStep::Kind::kWalk;
    step.to = map.point2("to");
    step.speed_mps = map.number("speed_mps", speed_mps, kPositive);
  } else if (map.has("wait_s")) {
    step.wait_s = map.number("wait_s", kNotNegative);
  } else if (map.has("robot_within_m")) {
    step.kind = PathStep::Kind::kWaitForRobot;
    step.robot_within_m = map.number("robot_within_m", kPositive);
    step.patience_s = map.number("patience_s", step.patience_s, {0.0, 1e9});
    step.comes_back = map.flag("comes_back", false);
  } else {
    if (!map.has("face")) map.fail("to", "or 'wait_s', 'robot_within_m', 'face' is missing");
    step.kind = PathStep::Kind::kFace;
    step.to = map.point2("face");
  }
  return step;
}

}  // namespace

ScenePerson readPerson(YamlMap& map, const Scene& scene) {
  const FloorBounds flat = floorBounds(scene);
  const FloorPlan plan(scene);
  const auto check = [&](YamlMap& where, const std::string& key, const Eigen::Vector2d& p) {
    if ((p.array() < flat.low.array()).any() || (p.array() > flat.high.array()).any()) {
      where.fail(key, "is outside the flat");
    }
    if (plan.clearance(p) < 0.05) where.fail(key, "is in a wall or in furniture");
  };
  ScenePerson person;
  person.name = map.text("name");
  person.height_m = map.number("height_m", person.height_m, {0.8, 2.3, false});
  person.build = map.number("build", person.build, {0.5, 2.0, false});
  person.start = map.point2("start");
  check(map, "start", person.start);
  person.start_yaw_rad = map.number("yaw_deg", 0.0) * kRadians;
  if (auto outfit = map.map("outfit", "outfit")) person.outfit = readOutfit(*outfit);
  const double speed_mps = map.number("speed_mps", 1.0, kPositive);
  for (YamlMap& entry : map.list("path", "step of a path")) {
    const PathStep step = readStep(entry, speed_mps);
    if (step.kind == PathStep::Kind::kWalk) check(entry, "to", step.to);
    entry.done();
    person.path.push_back(step);
  }
  person.repeat = map.flag("repeat", false);
  person.sees_robot = map.flag("sees_robot", true);
  if (person.repeat && person.path.empty()) map.fail("repeat", "needs a path");
  map.done();
  return person;
}

}  // namespace heel
