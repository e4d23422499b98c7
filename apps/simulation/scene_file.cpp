// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/simulation/floor_plan.hpp"
#include "apps/simulation/material.hpp"
#include "apps/simulation/scene.hpp"
#include "apps/simulation/yaml_map.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

namespace heel {
namespace {

constexpr double kRadians = 3.14159265358979323846 / 180.0;

Rgb readColor(YamlMap& map, const std::string& key, const Rgb& fallback) {
  if (!map.has(key)) return fallback;
  const std::string text = map.text(key);
  const auto color = parseColor(text);
  if (!color) {
    map.fail(key, "is '" + text + "', but must be \"#rrggbb\" or one of " + colorNames());
  }
  return *color;
}

/// Reads `material` and `color` of a map that may have other keys too.
Surface readSurface(YamlMap& map, const Surface& fallback) {
  Surface surface = fallback;
  if (map.has("material")) {
    surface.material = map.text("material");
    if (!isMaterial(surface.material)) {
      map.fail("material", "is '" + surface.material + "', but must be one of " + materialNames());
    }
    surface.color = usualColor(surface.material);
  }
  surface.color = readColor(map, "color", surface.color);
  return surface;
}

Surface readSurface(YamlMap& map, const std::string& key, const Surface& fallback) {
  auto inner = map.map(key, key);
  if (!inner) return fallback;
  const Surface surface = readSurface(*inner, fallback);
  inner->done();
  return surface;
}

Wall readWall(YamlMap& map, const Wall& usual) {
  Wall wall = usual;
  wall.from = map.point2("from");
  wall.to = map.point2("to");
  const double length = (wall.to - wall.from).norm();
  if (length < 0.01) map.fail("to", "is where the wall starts: a wall needs a length");
  wall.height_m = map.number("height_m", wall.height_m, kPositive);
  wall.thickness_m = map.number("thickness_m", wall.thickness_m, kPositive);
  wall.skirting_m = map.number("skirting_m", wall.skirting_m, kNotNegative);
  wall.left = wall.right = readSurface(map, wall.left);
  wall.left = readSurface(map, "left", wall.left);
  wall.right = readSurface(map, "right", wall.right);
  double clear_from = 0.0;
  for (YamlMap& entry : map.list("doors", "doorway")) {
    Doorway door;
    door.at_m = entry.number("at_m", kNotNegative);
    door.width_m = entry.number("width_m", door.width_m, kPositive);
    door.height_m = entry.number("height_m", door.height_m, kPositive);
    if (door.at_m - door.width_m / 2 < clear_from || door.at_m + door.width_m / 2 > length) {
      entry.fail("at_m", "puts it outside its wall, or over the doorway before it");
    }
    clear_from = door.at_m + door.width_m / 2;
    entry.done();
    wall.doors.push_back(door);
  }
  map.done();
  return wall;
}

FurniturePart readPart(YamlMap& map) {
  FurniturePart part;
  part.base = map.point3("at", Eigen::Vector3d::Zero());
  part.surface = readSurface(map, Surface{"wood", Rgb(0.4F, 0.25F, 0.13F)});
  if (map.has("box")) {
    part.size_m = map.point3("box");
    part.yaw_rad = map.number("yaw_deg", 0.0) * kRadians;
    if (part.size_m.minCoeff() <= 0.0) map.fail("box", "must have three positive sizes");
  } else if (map.has("cylinder")) {
    part.shape = FurniturePart::Shape::kCylinder;
    const Eigen::Vector2d size = map.point2("cylinder");
    part.radius_m = size.x();
    part.height_m = size.y();
    if (size.minCoeff() <= 0.0) map.fail("cylinder", "must have a positive radius and height");
  } else {
    map.fail("box", "or 'cylinder' is missing");
  }
  return part;
}

using Models = std::map<std::string, std::vector<FurniturePart>>;

Models readModels(const std::string& file) {
  Models models;
  YamlMap map = YamlMap::fromFile(file, "file of furniture models");
  for (const std::string& name : map.keys()) {
    for (YamlMap& entry : map.list(name, "part of " + name)) {
      models[name].push_back(readPart(entry));
      entry.done();
    }
  }
  return models;
}

/// Brings a part from its model's frame to the world.
FurniturePart placed(FurniturePart part, const Eigen::Vector3d& at, double yaw_rad) {
  const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
  const Eigen::Vector3d b = part.base;
  part.base = at + Eigen::Vector3d(c * b.x() - s * b.y(), s * b.x() + c * b.y(), b.z());
  part.yaw_rad += yaw_rad;
  return part;
}

Furniture readFurniture(YamlMap& map, const Models& models) {
  Furniture piece;
  piece.in_map = map.flag("in_map", true);
  if (!map.has("model")) {
    piece.parts.push_back(readPart(map));
    piece.name = map.text("name", "furniture");
    map.done();
    return piece;
  }
  const std::string model = map.text("model");
  const auto found = models.find(model);
  if (found == models.end()) map.fail("model", "is '" + model + "', which 'models' doesn't have");
  piece.name = map.text("name", model);
  const Eigen::Vector3d at = map.point3("at");
  const double yaw_rad = map.number("yaw_deg", 0.0) * kRadians;
  const Rgb tint = readColor(map, "color", Rgb(-1.0F, 0.0F, 0.0F));
  for (FurniturePart part : found->second) {
    // A piece's own colour is for its cushions and covers, not for its wooden legs.
    if (tint.x() >= 0.0F && part.surface.material == "fabric") part.surface.color = tint;
    piece.parts.push_back(placed(part, at, yaw_rad));
  }
  map.done();
  return piece;
}

Light readLight(YamlMap& map) {
  Light light;
  light.color = readColor(map, "color", light.color);
  if (map.has("window")) {
    light.kind = Light::Kind::kWindow;
    light.at = map.point3("window");
    light.color = readColor(map, "color", Rgb(0.85F, 0.94F, 1.0F));
    light.width_m = map.number("width_m", light.width_m, kPositive);
    light.height_m = map.number("height_m", light.height_m, kPositive);
    light.facing_rad = map.number("facing_deg") * kRadians;
  } else {
    if (!map.has("lamp")) map.fail("lamp", "or 'window' is missing");
    light.at = map.point3("lamp");
    light.radius_m = map.number("radius_m", light.radius_m, kPositive);
  }
  light.power = map.number("power", light.power, kNotNegative);
  map.done();
  return light;
}

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
  } else {
    if (!map.has("face")) map.fail("to", "or 'wait_s', 'robot_within_m', 'face' is missing");
    step.kind = PathStep::Kind::kFace;
    step.to = map.point2("face");
  }
  return step;
}

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
  if (person.repeat && person.path.empty()) map.fail("repeat", "needs a path");
  map.done();
  return person;
}

CameraParams readCamera(YamlMap& map) {
  CameraParams camera;
  camera.at = map.point3("at", camera.at);
  camera.pitch_rad = map.number("pitch_deg", camera.pitch_rad / kRadians, {-60, 60}) * kRadians;
  camera.width = map.integer("width", camera.width, 16, 4096);
  camera.height = map.integer("height", camera.height, 16, 4096);
  camera.horizontal_view_rad =
      map.number("view_deg", camera.horizontal_view_rad / kRadians, {5, 150}) * kRadians;
  camera.baseline_m = map.number("baseline_m", camera.baseline_m, kPositive);
  camera.rate_hz = map.number("rate_hz", camera.rate_hz, kPositive);
  camera.exposure = map.number("exposure", camera.exposure, kPositive);
  camera.read_noise = map.number("read_noise", camera.read_noise, kNotNegative);
  camera.shot_noise = map.number("shot_noise", camera.shot_noise, kNotNegative);
  camera.vignetting = map.number("vignetting", camera.vignetting, kShare);
  camera.blur_px = map.number("blur_px", camera.blur_px, {0.0, 3.0});
  map.done();
  return camera;
}

LaserParams readLaser(YamlMap& map) {
  LaserParams laser;
  laser.at = map.point3("at", laser.at);
  laser.view_rad = map.number("view_deg", laser.view_rad / kRadians, {1, 360}) * kRadians;
  laser.beams = map.integer("beams", laser.beams, 2, 100000);
  laser.rate_hz = map.number("rate_hz", laser.rate_hz, kPositive);
  laser.max_range_m = map.number("max_range_m", laser.max_range_m, kPositive);
  laser.noise_m = map.number("noise_m", laser.noise_m, kNotNegative);
  map.done();
  return laser;
}

OdometryParams readOdometry(YamlMap& map) {
  OdometryParams odometry;
  odometry.rate_hz = map.number("rate_hz", odometry.rate_hz, kPositive);
  odometry.distance_noise = map.number("distance_noise", odometry.distance_noise, kNotNegative);
  odometry.turn_noise = map.number("turn_noise", odometry.turn_noise, kNotNegative);
  odometry.drift_noise = map.number("drift_noise", odometry.drift_noise, kNotNegative);
  map.done();
  return odometry;
}

RobotParams readRobot(YamlMap& map) {
  RobotParams robot;
  robot.start = map.point2("start");
  robot.start_yaw_rad = map.number("yaw_deg", 0.0) * kRadians;
  robot.radius_m = map.number("radius_m", robot.radius_m, kPositive);
  robot.height_m = map.number("height_m", robot.height_m, kPositive);
  robot.max_speed_mps = map.number("max_speed_mps", robot.max_speed_mps, kPositive);
  robot.max_turn_radps = map.number("max_turn_radps", robot.max_turn_radps, kPositive);
  robot.max_acceleration_mps2 =
      map.number("max_acceleration_mps2", robot.max_acceleration_mps2, kPositive);
  robot.max_turn_acceleration_radps2 =
      map.number("max_turn_acceleration_radps2", robot.max_turn_acceleration_radps2, kPositive);
  if (auto camera = map.map("camera", "camera")) robot.camera = readCamera(*camera);
  if (auto laser = map.map("laser", "laser")) robot.laser = readLaser(*laser);
  if (auto odometry = map.map("odometry", "odometry")) robot.odometry = readOdometry(*odometry);
  map.done();
  return robot;
}

void readPeople(YamlMap& map, Scene& scene) {
  std::set<std::string> names;
  for (YamlMap& entry : map.list("people", "person")) {
    ScenePerson person = readPerson(entry, scene);
    if (!names.insert(person.name).second) entry.fail("name", "is another person's too");
    scene.people.push_back(std::move(person));
  }
}

}  // namespace

Scene loadScene(const std::string& file) {
  YamlMap map = YamlMap::fromFile(file, "scene");
  Scene scene;
  scene.name = map.text("name", std::filesystem::path(file).stem().string());
  scene.duration_s = map.number("duration_s", scene.duration_s, kPositive);
  scene.ceiling_m = map.number("ceiling_m", scene.ceiling_m, kNotNegative);
  scene.floor = readSurface(map, "floor", scene.floor);
  scene.ceiling = readSurface(map, "ceiling", scene.ceiling);
  Wall usual;
  if (scene.ceiling_m > 0.0) usual.height_m = scene.ceiling_m;
  usual.left = readSurface(map, "wall_surface", usual.left);
  for (YamlMap& entry : map.list("walls", "wall")) scene.walls.push_back(readWall(entry, usual));
  for (YamlMap& entry : map.list("floor_areas", "floor area")) {
    FloorArea area;
    area.low = entry.point2("low");
    area.high = entry.point2("high");
    if ((area.high - area.low).minCoeff() <= 0.0) entry.fail("high", "must be beyond 'low'");
    area.surface = readSurface(entry, scene.floor);
    entry.done();
    scene.floor_areas.push_back(area);
  }
  Models models;
  if (map.has("models")) {
    models = readModels((std::filesystem::path(file).parent_path() / map.text("models")).string());
  }
  for (YamlMap& entry : map.list("furniture", "piece of furniture")) {
    scene.furniture.push_back(readFurniture(entry, models));
  }
  for (YamlMap& entry : map.list("lights", "light")) scene.lights.push_back(readLight(entry));
  auto robot = map.map("robot", "robot");
  if (!robot) map.fail("robot", "is missing");
  scene.robot = readRobot(*robot);
  readPeople(map, scene);
  map.done();
  return scene;
}

}  // namespace heel
