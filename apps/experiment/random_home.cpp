// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/random_home.hpp>
#include <heel/apps/experiment/random_wardrobe.hpp>
#include <heel/apps/simulation/floor_plan.hpp>
#include <heel/apps/simulation/material.hpp>
#include <heel/apps/simulation/random.hpp>
#include <heel/planning/global_planner.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace heel {

namespace {

using Eigen::Vector2d;

constexpr double kDoorZone_m = 0.95;  // Nothing stands nearer to the middle of a doorway.
constexpr double kWallThickness_m = 0.12;

/// A model that stands against a wall: how deep it is, how wide.
struct Piece {
  const char* model;
  double depth_m;
  double width_m;
};
constexpr std::array<Piece, 10> kPieces = {{{"bookshelf", 0.3, 1.0},
                                            {"cupboard", 0.5, 1.2},
                                            {"wardrobe", 0.64, 1.4},
                                            {"desk", 0.65, 1.3},
                                            {"fridge", 0.7, 0.62},
                                            {"kitchen_block", 0.66, 1.86},
                                            {"armchair", 0.8, 0.8},
                                            {"sofa", 0.85, 2.1},
                                            {"television", 0.4, 1.4},
                                            {"plant", 0.54, 0.54}}};
/// What stands about, and no map shows.
constexpr std::array<const char*, 4> kLoose = {"carton", "stool", "bin", "chair"};
constexpr std::array<const char*, 6> kPaints = {"cream", "white",  "beige",
                                                "sand",  "silver", "mint"};
constexpr std::array<const char*, 8> kFabrics = {"teal", "mustard", "slate",    "rust",
                                                 "navy", "olive",   "burgundy", "charcoal"};
constexpr std::array<const char*, 3> kWallMaterials = {"plaster", "roughcast", "wallpaper"};

template <std::size_t N>
const char* pick(const std::array<const char*, N>& names, RandomStream& random) {
  return names[static_cast<std::size_t>(random.uniform() * static_cast<double>(N))];
}

/// Draws one home.
class Builder {
 public:
  Builder(std::uint64_t seed, const FurnitureModels& models) : random_(seed), models_(models) {}

  RandomHome build() {
    layOutRooms();
    placeRobot();
    for (std::size_t i = 0; i + 1 < home_.rooms.size(); ++i) furnish(home_.rooms[i]);
    light();
    return std::move(home_);
  }

 private:
  void layOutRooms();
  void addWall(const Vector2d& from, const Vector2d& to, std::vector<double> doors_at = {});
  double doorway(double low, double high) { return random_.uniform(low + 0.75, high - 0.75); }
  void placeRobot();
  void furnish(const Room& room);
  void standAtWall(const Room& room);
  void standLoose(const Room& room);
  bool add(const char* model, const Vector2d& at, double yaw_rad, const Vector2d& half,
           bool in_map);
  bool isFree(const Vector2d& at, double yaw_rad, const Vector2d& half) const;
  void light();

  RandomStream random_;
  const FurnitureModels& models_;
  RandomHome home_;
  std::vector<Vector2d> doors_;
};

void Builder::addWall(const Vector2d& from, const Vector2d& to, std::vector<double> doors_at) {
  Wall wall;
  wall.from = from;
  wall.to = to;
  wall.thickness_m = kWallThickness_m;
  wall.left = {pick(kWallMaterials, random_), *parseColor(pick(kPaints, random_))};
  wall.right = {pick(kWallMaterials, random_), *parseColor(pick(kPaints, random_))};
  std::sort(doors_at.begin(), doors_at.end());
  for (const double at_m : doors_at) {
    Doorway door;
    door.at_m = at_m;
    door.width_m = random_.uniform(0.85, 1.05);
    wall.doors.push_back(door);
    doors_.push_back(from + (to - from).normalized() * at_m);
  }
  home_.scene.walls.push_back(wall);
}

// Two rooms below the hall, three above it.
void Builder::layOutRooms() {
  const double width = random_.uniform(9.6, 11.4);
  const double hall_low = random_.uniform(3.5, 4.4);
  const double hall_high = hall_low + random_.uniform(1.35, 1.8);
  const double height = hall_high + random_.uniform(3.2, 4.0);
  const double below = random_.uniform(4.9, 5.6);
  const double above_1 = width / 3.0 + random_.uniform(-0.3, 0.3);
  const double above_2 = 2.0 * width / 3.0 + random_.uniform(-0.3, 0.3);
  home_.rooms = {{"living room", {0.0, 0.0}, {below, hall_low}},
                 {"kitchen", {below, 0.0}, {width, hall_low}},
                 {"bedroom", {0.0, hall_high}, {above_1, height}},
                 {"study", {above_1, hall_high}, {above_2, height}},
                 {"bath", {above_2, hall_high}, {width, height}},
                 {"hall", {0.0, hall_low}, {width, hall_high}}};
  addWall({0.0, 0.0}, {width, 0.0});
  addWall({width, 0.0}, {width, height});
  addWall({width, height}, {0.0, height});
  addWall({0.0, height}, {0.0, 0.0});
  addWall({0.0, hall_low}, {width, hall_low}, {doorway(2.2, below), doorway(below, width)});
  addWall({0.0, hall_high}, {width, hall_high},
          {doorway(0.0, above_1), doorway(above_1, above_2), doorway(above_2, width)});
  const bool joined = random_.uniform() < 0.4;
  addWall({below, 0.0}, {below, hall_low},
          joined ? std::vector<double>{doorway(0.3, hall_low - 0.3)} : std::vector<double>{});
  addWall({above_1, hall_high}, {above_1, height});
  addWall({above_2, hall_high}, {above_2, height});

  Scene& scene = home_.scene;
  scene.floor = {"parquet", usualColor("parquet")};
  for (const Room& room : home_.rooms) {
    const std::array<const char*, 3> floors = {"parquet", "tiles", "carpet"};
    const char* floor = pick(floors, random_);
    const Vector2d inside = Vector2d::Constant(kWallThickness_m / 2.0);
    scene.floor_areas.push_back(
        {room.low + inside, room.high - inside, {floor, usualColor(floor)}});
  }
}

void Builder::placeRobot() {
  const Room& living = home_.rooms.front();
  RobotParams& robot = home_.scene.robot;
  robot.start = {0.75, (living.low.y() + living.high.y()) / 2.0 + random_.uniform(-0.25, 0.25)};
  robot.start_yaw_rad = random_.uniform(-0.08, 0.08);
}

void Builder::furnish(const Room& room) {
  const int at_walls = 2 + static_cast<int>(random_.uniform() * 3.0);
  for (int i = 0; i < at_walls; ++i) standAtWall(room);
  if (random_.uniform() < 0.7) standLoose(room);
}

void Builder::standAtWall(const Room& room) {
  for (int attempt = 0; attempt < 20; ++attempt) {
    const Piece& piece = kPieces[static_cast<std::size_t>(random_.uniform() * kPieces.size())];
    const int side = static_cast<int>(random_.uniform() * 4.0);  // Left, right, lower, upper wall.
    const double back = kWallThickness_m / 2.0 + 0.06 + piece.depth_m / 2.0;
    const double reach = piece.width_m / 2.0 + kWallThickness_m / 2.0 + 0.04;
    const bool upright = side < 2;
    const double low = (upright ? room.low.y() : room.low.x()) + reach;
    const double high = (upright ? room.high.y() : room.high.x()) - reach;
    if (low >= high) continue;
    const double along = random_.uniform(low, high);
    const std::array<Vector2d, 4> at = {{{room.low.x() + back, along},
                                         {room.high.x() - back, along},
                                         {along, room.low.y() + back},
                                         {along, room.high.y() - back}}};
    const std::array<double, 4> yaw = {0.0, M_PI, M_PI / 2.0, -M_PI / 2.0};
    const auto s = static_cast<std::size_t>(side);
    if (add(piece.model, at[s], yaw[s], {piece.depth_m / 2.0, piece.width_m / 2.0},
            random_.uniform() < 0.8)) {
      return;
    }
  }
}

void Builder::standLoose(const Room& room) {
  for (int attempt = 0; attempt < 20; ++attempt) {
    const Vector2d at(random_.uniform(room.low.x() + 0.4, room.high.x() - 0.4),
                      random_.uniform(room.low.y() + 0.4, room.high.y() - 0.4));
    // A robot passes on one side at least: near a wall, or in the open.
    const double clear_m = FloorPlan(home_.scene).clearance(at);
    if (clear_m > 0.45 && clear_m < 1.1) continue;
    const double yaw = random_.uniform(-M_PI, M_PI);
    if (add(pick(kLoose, random_), at, yaw, {0.26, 0.26}, false)) return;
  }
}

bool Builder::add(const char* model, const Vector2d& at, double yaw_rad, const Vector2d& half,
                  bool in_map) {
  if (!isFree(at, yaw_rad, half)) return false;
  Furniture piece = placeFurniture(models_, model, {at.x(), at.y(), 0.0}, yaw_rad,
                                   *parseColor(pick(kFabrics, random_)));
  piece.in_map = in_map;
  home_.scene.furniture.push_back(std::move(piece));
  return true;
}

// Clear of walls, other pieces, doorways, and of the place before the robot.
bool Builder::isFree(const Vector2d& at, double yaw_rad, const Vector2d& half) const {
  const FloorPlan plan(home_.scene);
  const RobotParams& robot = home_.scene.robot;
  const Eigen::Rotation2Dd turn(yaw_rad);
  const Eigen::Rotation2Dd to_robot(-robot.start_yaw_rad);
  for (double u = -1.0; u <= 1.001; u += 0.25) {
    for (double v = -1.0; v <= 1.001; v += 0.25) {
      const Vector2d p = at + turn * Vector2d(u * half.x(), v * half.y());
      if (plan.clearance(p) < 0.03) return false;
      for (const Vector2d& door : doors_) {
        if ((p - door).norm() < kDoorZone_m) return false;
      }
      const Vector2d seen = to_robot * (p - robot.start);
      if (seen.x() > -0.55 && seen.x() < 3.9 && std::abs(seen.y()) < 1.15) return false;
    }
  }
  return true;
}

void Builder::light() {
  for (const Room& room : home_.rooms) {
    const Vector2d size = room.high - room.low;
    const int lamps = size.maxCoeff() > 6.0 ? 2 : 1;
    for (int i = 0; i < lamps; ++i) {
      Light lamp;
      const double share = (i + 0.5) / lamps;
      const Vector2d at = room.low + Vector2d(size.x() * share, size.y() / 2.0);
      lamp.at = {at.x(), at.y(), 2.5};
      lamp.power = random_.uniform(22.0, 34.0);
      lamp.radius_m = 0.2;
      const auto warmth = static_cast<float>(random_.uniform(-0.05, 0.05));
      lamp.color *= Rgb(1.0F + warmth, 1.0F, 1.0F - warmth);
      home_.scene.lights.push_back(lamp);
    }
  }
}

}  // namespace

RandomHome randomHome(std::uint64_t seed, const std::filesystem::path& models) {
  const FurnitureModels furniture = loadFurnitureModels(models.string());
  RandomHome home = Builder(hashOf(seed, 30), furniture).build();
  home.scene.name = "home " + std::to_string(seed);
  return home;
}

namespace {

constexpr double kBodyRadius_m = 0.3;  // With a little room to walk.
constexpr double kWaitsEvery_m = 2.2;  // Of the person's way.
constexpr double kCell_m = 0.05;

OccupancyGrid rasterized(const Scene& scene) {
  const FloorBounds flat = floorBounds(scene);
  const Vector2d size = (flat.high - flat.low) / kCell_m;
  OccupancyGrid grid(flat.low, kCell_m, static_cast<int>(size.x()) + 1,
                     static_cast<int>(size.y()) + 1);
  const FloorPlan plan(scene);
  for (int y = 0; y < grid.height(); ++y) {
    for (int x = 0; x < grid.width(); ++x) {
      const GridCell cell{x, y};
      if (plan.clearance(grid.center(cell)) < kCell_m / 2.0) grid.at(cell) = Occupancy::kOccupied;
    }
  }
  return grid;
}

GlobalPlannerParams walking() {
  GlobalPlannerParams params;
  params.robot_radius_m = kBodyRadius_m;
  return params;
}

/// Writes people's ways through a home.
class Ways {
 public:
  Ways(const RandomHome& home, RandomStream& random)
      : home_(home),
        random_(random),
        plan_(home.scene),
        planner_(rasterized(home.scene), walking()) {}

  /// A free place of a room that can be reached from `from`; `from` itself if none was found.
  Vector2d placeIn(const Room& room, const Vector2d& from) {
    for (int attempt = 0; attempt < 50; ++attempt) {
      const Vector2d place(random_.uniform(room.low.x() + 0.6, room.high.x() - 0.6),
                           random_.uniform(room.low.y() + 0.6, room.high.y() - 0.6));
      if (plan_.clearance(place) < 0.55) continue;
      if (planner_.plan(from, place).status == PlanStatus::kFound) return place;
    }
    return from;
  }

  /// Walks there; if `waits`, stops every few metres until the robot has come near.
  void walk(ScenePerson& person, Vector2d& at, const Vector2d& to, double speed_mps, bool waits) {
    const GlobalPlan way = planner_.plan(at, to);
    if (!way.found()) return;
    double gone_m = 0.0;
    for (const Vector2d& corner : resample(way.path, 1.1)) {
      if (corner == way.path.front()) continue;
      gone_m += (corner - at).norm();
      at = corner;
      PathStep step;
      step.kind = PathStep::Kind::kWalk;
      step.to = corner;
      step.speed_mps = speed_mps;
      person.path.push_back(step);
      if (!waits || gone_m < kWaitsEvery_m) continue;
      gone_m = 0.0;
      waitForRobot(person, random_.uniform(1.6, 2.2), 25.0);
    }
  }

  void waitForRobot(ScenePerson& person, double within_m, double patience_s) const {
    PathStep step;
    step.kind = PathStep::Kind::kWaitForRobot;
    step.robot_within_m = within_m;
    step.patience_s = patience_s;
    step.comes_back = true;
    person.path.push_back(step);
  }

  void wait(ScenePerson& person, double wait_s) const {
    PathStep step;
    step.wait_s = wait_s;
    person.path.push_back(step);
  }

  const Room& randomRoom() {
    const auto rooms = static_cast<double>(home_.rooms.size());
    return home_.rooms[static_cast<std::size_t>(random_.uniform() * rooms)];
  }

 private:
  const RandomHome& home_;
  RandomStream& random_;
  FloorPlan plan_;
  GlobalPlanner planner_;
};

/// In from beside the robot, where it does not look; about before it, so that it sees all sides.
void showUp(ScenePerson& person, Vector2d& at, const RobotParams& robot, double empty_s, Ways& ways,
            RandomStream& random) {
  const Eigen::Rotation2Dd turn(robot.start_yaw_rad);
  const auto place = [&](double x, double y) -> Vector2d {
    return robot.start + turn * Vector2d(x, y);
  };
  const double side = random.uniform() < 0.5 ? 1.0 : -1.0;
  person.start = at = place(0.1, 0.95 * side);
  person.start_yaw_rad = robot.start_yaw_rad;
  ways.wait(person, empty_s);
  const double speed_mps = random.uniform(0.6, 0.9);
  for (const Vector2d& to : {place(2.0, 0.5 * side), place(2.6, -0.6), place(3.3, 0.5),
                             place(2.2, 0.3), place(2.8, -0.2)}) {
    PathStep step;
    step.kind = PathStep::Kind::kWalk;
    step.to = at = to;
    step.speed_mps = speed_mps;
    person.path.push_back(step);
    ways.wait(person, 0.4);
  }
  ways.waitForRobot(person, 1.7, 12.0);
}

/// The first is the one to follow: anybody, and whoever looks like them may be about.
std::vector<ScenePerson> inAnyOrder(std::vector<ScenePerson> people, std::uint64_t seed) {
  RandomStream random(hashOf(seed, 33));
  for (std::size_t i = people.size(); i > 1; --i) {
    std::swap(people[i - 1],
              people[static_cast<std::size_t>(random.uniform() * static_cast<double>(i))]);
  }
  return people;
}

}  // namespace

Scene randomEpisode(std::uint64_t seed, const std::filesystem::path& scenes,
                    const RandomEpisodeParams& params) {
  RandomHome home = randomHome(seed, scenes / "models" / "furniture.yaml");
  RandomStream random(hashOf(seed, 31));
  Ways ways(home, random);

  const std::vector<ScenePerson> people = inAnyOrder(randomWardrobe(seed).people, seed);
  ScenePerson person = people.front();
  Vector2d at;
  showUp(person, at, home.scene.robot, params.empty_s, ways, random);
  const double speed_mps = random.uniform(0.4, 0.7);
  for (int visit = 0; visit < params.visits; ++visit) {
    ways.walk(person, at, ways.placeIn(ways.randomRoom(), at), speed_mps, true);
    ways.waitForRobot(person, 1.5, 40.0);
    ways.wait(person, random.uniform(0.5, 2.0));
  }
  home.scene.people.push_back(std::move(person));

  const int others = static_cast<int>(random.uniform() * (params.max_others + 1));
  for (int i = 0; i < others; ++i) {
    ScenePerson other = people[static_cast<std::size_t>(1 + i)];
    const std::size_t room = 1 + static_cast<std::size_t>(random.uniform() * 4.0);
    const Vector2d doorstep = home.rooms.back().low + Vector2d(1.0 + 3.0 * i, 0.7);
    Vector2d where = ways.placeIn(home.rooms[room], doorstep);
    other.start = where;
    ways.wait(other, 17.0);  // So that the first to enter is the one to follow.
    const Vector2d first = where;
    for (int walk = 0; walk < 4; ++walk) {
      ways.walk(other, where, ways.placeIn(ways.randomRoom(), where), random.uniform(0.5, 1.0),
                false);
      ways.wait(other, random.uniform(1.0, 5.0));
    }
    ways.walk(other, where, first, random.uniform(0.5, 1.0), false);
    other.repeat = true;
    home.scene.people.push_back(std::move(other));
  }

  CameraParams& camera = home.scene.robot.camera;
  camera.width = 320;
  camera.height = 240;
  camera.rate_hz = params.camera_rate_hz;
  camera.drawn_light = true;
  home.scene.robot.floor_camera.emplace();
  LaserParams& laser = home.scene.robot.laser;
  laser.view_rad = 2.0 * M_PI;  // People who pass by the robot stay in view of it.
  laser.beams = 361;
  home.scene.name = "episode " + std::to_string(seed);
  return std::move(home.scene);
}

}  // namespace heel
