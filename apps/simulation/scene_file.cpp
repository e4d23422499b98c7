// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/simulation/material.hpp>
#include <heel/apps/simulation/scene.hpp>
#include <heel/apps/simulation/scene_parts.hpp>
#include <heel/cloud/yaml_map.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

namespace heel {
namespace {

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

/// Brings a part from its model's frame to the world.
FurniturePart placed(FurniturePart part, const Eigen::Vector3d& at, double yaw_rad) {
  const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
  const Eigen::Vector3d b = part.base;
  part.base = at + Eigen::Vector3d(c * b.x() - s * b.y(), s * b.x() + c * b.y(), b.z());
  part.yaw_rad += yaw_rad;
  return part;
}

Furniture readFurniture(YamlMap& map, const FurnitureModels& models) {
  Furniture piece;
  if (!map.has("model")) {
    piece.parts.push_back(readPart(map));
    piece.name = map.text("name", "furniture");
  } else {
    const std::string model = map.text("model");
    if (models.count(model) == 0) {
      map.fail("model", "is '" + model + "', which 'models' doesn't have");
    }
    const std::string name = map.text("name", model);
    const Eigen::Vector3d at = map.point3("at");
    const double yaw_rad = map.number("yaw_deg", 0.0) * kRadians;
    std::optional<Rgb> tint;
    if (map.has("color")) tint = readColor(map, "color", Rgb::Zero());
    piece = placeFurniture(models, model, at, yaw_rad, tint);
    piece.name = name;
  }
  piece.in_map = map.flag("in_map", true);
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

void readPeople(YamlMap& map, Scene& scene) {
  std::set<std::string> names;
  for (YamlMap& entry : map.list("people", "person")) {
    ScenePerson person = readPerson(entry, scene);
    if (!names.insert(person.name).second) entry.fail("name", "is another person's too");
    scene.people.push_back(std::move(person));
  }
}

}  // namespace

FurnitureModels loadFurnitureModels(const std::string& file) {
  FurnitureModels models;
  YamlMap map = YamlMap::fromFile(file, "file of furniture models");
  for (const std::string& name : map.keys()) {
    for (YamlMap& entry : map.list(name, "part of " + name)) {
      models[name].push_back(readPart(entry));
      entry.done();
    }
  }
  return models;
}

Furniture placeFurniture(const FurnitureModels& models, const std::string& model,
                         const Eigen::Vector3d& at, double yaw_rad,
                         const std::optional<Rgb>& tint) {
  Furniture piece;
  piece.name = model;
  for (FurniturePart part : models.at(model)) {
    // A piece's own colour is for its cushions and covers, not for its wooden legs.
    if (tint && part.surface.material == "fabric") part.surface.color = *tint;
    piece.parts.push_back(placed(part, at, yaw_rad));
  }
  return piece;
}

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
    area.depth_m = entry.number("depth_m", 0.0, kNotNegative);
    entry.done();
    scene.floor_areas.push_back(area);
  }
  FurnitureModels models;
  if (map.has("models")) {
    models = loadFurnitureModels(
        (std::filesystem::path(file).parent_path() / map.text("models")).string());
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
