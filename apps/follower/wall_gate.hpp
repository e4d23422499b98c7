// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The paper's geometric filtering (section 3.2): no person is inside a wall or behind one.
#pragma once

#include <heel/cloud/pinhole_camera.hpp>
#include <heel/mapping/floor_pose.hpp>
#include <heel/mapping/wall_map.hpp>
#include <heel/tracking/geometric_gate.hpp>

#include <memory>

namespace heel {

/// How far what is seen may be off, and how a person is looked for.
struct WallGateParams {
  /// The pose of the observations' frame in the map: that of the robot's base, if they are in its
  /// frame; the identity if they are in the map's.
  FloorPose observations_in_map;
  double eye_height_m = 1.15;  ///< Height of the camera over the floor.
  /// Height at which rays to a person end; they pass over what is lower.
  double body_height_m = 1.3;
  double half_body_m = 0.15;  ///< Nobody's middle is nearer to a wall than this.
  /// What the map shows between these heights counts as a wall for half_body_m.
  HeightBand body{0.95, 1.9};
  double sigmas = 2.0;  ///< So many standard deviations of the place are allowed for.
};

/// A depth's standard deviation over its square [1/m], of a stereo camera whose disparities have
/// this one. People are
/// seen better than by the default, but plain walls, of which the gate is to know, are often seen
/// nearer than they are by a whole disparity: that is two deviations.
double depthErrorOf(const StereoCamera& camera, double disparity_error_px = 0.5);

/// Casts a ray from the camera through each observation.
///
/// - A wall crosses it before the observation: kBehindWall.
/// - A wall is on it within half a body and `sigmas` of the observation's own standard deviation
///   along the ray (with stereo, it grows with the square of the range) to either side of the
///   observation, or is within half a body of it to any side: kInsideWall. What is seen there may
///   be the wall itself; a doubtful depth counts against an observation, for it is doubtful for a
///   moment only and the track goes on without it.
///
/// Where the robot is, may be doubtful for long, and counts for the observation: it is refused only
/// if it would be from wherever the camera may be, i.e. also with camera and observation shifted
/// together by `sigmas` standard deviations to both sides along both axes of the viewpoint's
/// covariance. A camera is not in a wall: such places are left out, and if none is left the map
/// says nothing. So a lost robot's gate opens.
///
/// Allocates nothing when called; may be called from many threads.
/// @throws std::invalid_argument  if there is no map or a parameter is negative or not finite.
GeometricGate wallGate(std::shared_ptr<const WallMap> map, const WallGateParams& params = {});

}  // namespace heel
