// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A scene: what a world is made of, as its YAML file says it. World frame: X, Y on the floor, Z
/// up.
#pragma once

#include <heel/apps/simulation/color.hpp>
#include <heel/planning/trajectory.hpp>

#include <Eigen/Core>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace heel {

/// How a surface looks: the name of a material (see material.hpp), tinted with a colour.
struct Surface {
  std::string material = "plaster";
  Rgb color = Rgb(0.8F, 0.8F, 0.78F);
};

/// A gap in a wall.
struct Doorway {
  double at_m = 0.0;       ///< Its middle, from the wall's start.
  double width_m = 0.9;    ///< Clear width.
  double height_m = 2.05;  ///< The wall goes on above it.
};

/// An upright wall; `from` and `to` are the ends of its middle line.
struct Wall {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
  double height_m = 2.6;
  double thickness_m = 0.12;
  double skirting_m = 0.07;    ///< Height of the skirting board; 0 = none.
  Surface left;                ///< The side on the left hand when going from start to end.
  Surface right;               ///< The other side.
  std::vector<Doorway> doors;  ///< Sorted along the wall, not overlapping.
};

/// A rectangle of floor with a look of its own (a rug, another room's floor), or a step down.
struct FloorArea {
  Eigen::Vector2d low = Eigen::Vector2d::Zero();
  Eigen::Vector2d high = Eigen::Vector2d::Zero();
  Surface surface;
  double depth_m = 0.0;  ///< So far below the floor it is. No map shows it.
};

/// A box or an upright cylinder; `base` is the middle of its lower side.
struct FurniturePart {
  enum class Shape { kBox, kCylinder };
  Shape shape = Shape::kBox;
  Eigen::Vector3d base = Eigen::Vector3d::Zero();
  Eigen::Vector3d size_m = Eigen::Vector3d::Ones();  ///< Of a box, along its own axes.
  double yaw_rad = 0.0;                              ///< Of a box.
  double radius_m = 0.0;                             ///< Of a cylinder.
  double height_m = 0.0;                             ///< Of a cylinder.
  Surface surface;
};

/// Something that stands in the flat. Its parts are in the world frame.
struct Furniture {
  std::string name;
  bool in_map = true;  ///< Whether the robot's map shows it.
  std::vector<FurniturePart> parts;
};

/// A lamp (a sphere) or a window (an upright rectangle that lets daylight in).
struct Light {
  enum class Kind { kLamp, kWindow };
  Kind kind = Kind::kLamp;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  ///< Its middle.
  double power = 60.0;                           ///< Of light; irradiance = power / (4 pi d^2).
  Rgb color = Rgb(1.0F, 0.93F, 0.82F);
  double radius_m = 0.14;   ///< Of a lamp.
  double width_m = 1.2;     ///< Of a window.
  double height_m = 1.2;    ///< Of a window.
  double facing_rad = 0.0;  ///< Direction into the room of a window.
};

/// What cloth looks like from one side.
struct Cloth {
  enum class Pattern { kPlain, kStripes, kChecks };
  Pattern pattern = Pattern::kPlain;
  Rgb color = Rgb(0.3F, 0.3F, 0.3F);
  Rgb second = Rgb(0.8F, 0.8F, 0.8F);  ///< The other colour of stripes and checks.
  double width_m = 0.05;               ///< Of one stripe or check.
};

/// A piece of clothing; the back is as the front unless it says otherwise.
struct Garment {
  Cloth front;
  std::optional<Cloth> back;
};

/// What a person wears, and their hair and skin.
struct Outfit {
  Garment top;
  Garment trousers;
  bool long_sleeves = true;
  bool long_hair = false;
  bool skirt = false;  ///< A long one of the trousers' cloth instead of them.
  Rgb shoes = Rgb(0.03F, 0.03F, 0.03F);
  Rgb hair = Rgb(0.05F, 0.03F, 0.02F);
  Rgb skin = Rgb(0.7F, 0.45F, 0.32F);
};

/// One step of what a person does.
struct PathStep {
  enum class Kind { kWalk, kWait, kWaitForRobot, kFace };
  Kind kind = Kind::kWait;
  Eigen::Vector2d to = Eigen::Vector2d::Zero();  ///< Where to walk to, or what to turn to.
  double speed_mps = 1.0;                        ///< Of a walk.
  double wait_s = 0.0;                           ///< How long to wait.
  double robot_within_m = 0.0;                   ///< Until the robot is as near as this, in sight,
  double patience_s = 1e9;                       ///< ... or for as long as this.
  /// After that goes back the way they came, until they see the robot as near, and begin again
  /// from there; else goes on without it.
  bool comes_back = false;
};

/// A person: body, clothes and what they do.
struct ScenePerson {
  std::string name;
  double height_m = 1.75;
  double build = 1.0;  ///< Width of the body; 1 = average.
  Outfit outfit;
  Eigen::Vector2d start = Eigen::Vector2d::Zero();
  double start_yaw_rad = 0.0;
  std::vector<PathStep> path;
  bool repeat = false;  ///< Begins again when the path is done.
  /// Who does not see the robot bumps into it, then steps round it; they neither wait for it nor
  /// come back nor make room for it.
  bool sees_robot = true;
};

/// A rectified stereo pair of cameras, mounted on the robot.
struct CameraParams {
  /// Place of the left camera in the robot's base frame [m].
  Eigen::Vector3d at{0.05, 0.06, 1.0};
  double pitch_rad = 0.0;             ///< How far the camera looks down.
  int width = 320;                    ///< Width of the images [px].
  int height = 240;                   ///< Height of the images [px].
  double horizontal_view_rad = 1.05;  ///< Horizontal field of view.
  /// Distance between the cameras; a longer one measures further, and less of what is near.
  double baseline_m = 0.12;
  double rate_hz = 10.0;    ///< Pictures per second.
  double exposure = 2.0;    ///< Signal for a radiance of 1; a signal of 1 saturates.
  double read_noise = 0.2;  ///< Standard deviation in the dark [of 255 levels of light].
  /// Standard deviation at half of full light [of 255 levels of light].
  double shot_noise = 2.0;
  double vignetting = 0.25;  ///< Share of the light that is lost in the corners.
  double blur_px = 0.5;      ///< Standard deviation of the lens's blur.
  /// Whether exposure, white balance, gamma, motion blur and flicker are drawn from the run's seed
  /// (DrawnLight); else the light stays as it is.
  bool drawn_light = false;
};

/// A depth camera over the robot's front rim that looks at the floor.
struct FloorCameraParams {
  Eigen::Vector3d at{0.22, 0.0, 1.0};   ///< Its place in the robot's base frame [m].
  double pitch_rad = 0.87266462599716;  ///< How far it looks down.
  int width = 128;                      ///< Width of the images [px].
  int height = 96;                      ///< Height of the images [px].
  double horizontal_view_rad = 1.4;     ///< Horizontal field of view.
  double rate_hz = 10.0;                ///< Pictures per second.
  double max_range_m = 4.0;             ///< It sees nothing further away than this.
  double noise_m = 0.01;                ///< Standard deviation of a depth.
};

/// A planar laser scanner, mounted on the robot.
struct LaserParams {
  Eigen::Vector3d at{0.12, 0.0, 0.3};  ///< Place of the laser in the robot's base frame [m].
  double view_rad = 3.14159265358979;  ///< Angle from the first beam to the last.
  int beams = 181;                     ///< Beams of a scan.
  double rate_hz = 10.0;               ///< Scans per second.
  double max_range_m = 20.0;           ///< Beams see nothing further away than this.
  double noise_m = 0.01;               ///< Standard deviation of a range.
  double latency_s = 0.0;              ///< A scan comes at most so long after it was measured.
};

/// Errors of the wheels' odometry, as standard deviations that grow with the way gone.
struct OdometryParams {
  double rate_hz = 10.0;         ///< Readings per second.
  double distance_noise = 0.02;  ///< Error of the distance, per square root of a metre gone [m].
  double turn_noise = 0.02;    ///< Error of the heading, per square root of a radian turned [rad].
  double drift_noise = 0.01;   ///< Error of the heading, per square root of a metre gone [rad].
  double distance_bias = 0.0;  ///< Error of the distance that stays, as a share of it.
  double turn_bias = 0.0;      ///< Error of a turn that stays, as a share of it.
  double drift_bias = 0.0;     ///< Error of the heading that stays, per metre gone [rad].
};

/// A differential-drive robot. The defaults are a Pioneer 3-DX at the paper's speed.
struct RobotParams {
  Eigen::Vector2d start = Eigen::Vector2d::Zero();  ///< Where the robot is at the beginning [m].
  double start_yaw_rad = 0.0;                       ///< Its heading at the beginning.
  DriveLimits drive;                                ///< Its size and how it drives.
  double height_m = 1.1;                            ///< Height of the robot.
  /// A command acts on the wheels at most so long after it was sent, and odometry comes at most so
  /// late.
  double wheels_latency_s = 0.0;
  CameraParams camera;
  std::optional<FloorCameraParams> floor_camera;
  LaserParams laser;
  OdometryParams odometry;
};

/// Everything that a scene file says.
struct Scene {
  std::string name;
  double duration_s = 30.0;  ///< How long a recording of it is unless asked otherwise.
  double ceiling_m = 2.6;    ///< Height of the ceiling; 0 = none.
  Surface floor{"parquet", Rgb(0.5F, 0.3F, 0.16F)};
  Surface ceiling{"plaster", Rgb(0.85F, 0.85F, 0.83F)};
  std::vector<FloorArea> floor_areas;
  std::vector<Wall> walls;
  std::vector<Furniture> furniture;
  std::vector<Light> lights;
  std::vector<ScenePerson> people;
  RobotParams robot;
};

/// The corners of the rectangle around all walls; a 10 m square where there are none.
struct FloorBounds {
  Eigen::Vector2d low;
  Eigen::Vector2d high;
};
FloorBounds floorBounds(const Scene& scene);

/// Furniture that scenes can place: parts in the model's own frame, front along +x.
using FurnitureModels = std::map<std::string, std::vector<FurniturePart>>;

/// @throws std::runtime_error  as loadScene().
FurnitureModels loadFurnitureModels(const std::string& file);

/// A model's piece in the world.
/// @param tint  Colour of its cushions and covers; absent: the model's own.
/// @throws std::out_of_range  if there is no such model.
Furniture placeFurniture(const FurnitureModels& models, const std::string& model,
                         const Eigen::Vector3d& at, double yaw_rad,
                         const std::optional<Rgb>& tint = std::nullopt);

/// Reads a scene. Every key has a default but names, places and sizes.
/// @throws std::runtime_error  one sentence with file, line and key: unknown key, wrong type or
///         range, wall without length, doorway outside its wall, person outside the flat, ...
Scene loadScene(const std::string& file);

}  // namespace heel
