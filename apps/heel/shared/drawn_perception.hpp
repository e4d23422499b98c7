// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What a perception step found, ready to be drawn.
#pragma once

#include <heel/apps/follower/perception.hpp>
#include <heel/apps/pictures/annotate.hpp>
#include <heel/apps/pictures/trails.hpp>

#include <map>

namespace heel {

/// Turns steps into drawings; remembers where tracks were and how tall people are.
class DrawnPerception {
 public:
  explicit DrawnPerception(const CameraSetup& setup) : setup_(setup) {}

  /// @param robot  Base frame to the world, as it was given to the perception.
  /// @return the drawing, in the world; its images are the step's own, valid as long as these.
  DrawnFrame& of(const Frame& frame, const Perception& perception, const PerceptionStep& step,
                 const FloorPose& robot = {});

 private:
  void addBlobs(const Perception& perception, const PerceptionStep& step, const FloorPose& robot);
  void addTracks(const Perception& perception, const PerceptionStep& step);

  CameraSetup setup_;
  DrawnFrame drawing_;
  Trails trails_;
  std::map<int, double> heights_m_;  // of tracks that are alive
};

}  // namespace heel
