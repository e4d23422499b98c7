// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Results as standard messages, in a bag or on a network.
#pragma once

#include <heel/apps/bag/bag.hpp>
#include <heel/mapping/floor_pose.hpp>
#include <heel/mapping/occupancy_grid.hpp>
#include <heel/planning/path.hpp>
#include <heel/tracking/target.hpp>
#include <heel/tracking/tracker.hpp>

#include <opencv2/core/mat.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace heel {

/// Writes what RViz and other viewers show, all of it in one frame, `map` if no other is named:
///
/// | topic | holds |
/// | --- | --- |
/// | `/heel/tracks` | PoseArray: everyone who is tracked, facing where they go |
/// | `/heel/markers` | MarkerArray: the same as cylinders with their numbers; the target is green |
/// | `/heel/target` | PoseStamped: the target, while it has a place |
/// | `/heel/path` | Path: the way that the robot wants to go |
/// | `/map` | OccupancyGrid |
/// | `/heel/image/compressed` | what was seen, with all that was found drawn over it; JPEG |
/// | `/tf` | that frame to base_footprint |
class ResultBag {
 public:
  /// @throws std::invalid_argument, std::runtime_error  as createBag(); the latter, so do the
  /// others.
  explicit ResultBag(const BagPlan& plan, std::string frame = "map");
  /// On a network, where tracks, target, path and image are made known at once.
  ResultBag(std::unique_ptr<BagWriter> network, std::string frame);

  /// Empty on a network.
  const std::filesystem::path& path() const { return path_; }

  void addRobot(double stamp_s, const FloorPose& pose);
  /// Tracks that are not confirmed yet are left out.
  void addTracks(double stamp_s, const std::vector<Track>& tracks, const TargetEstimate& target);
  void addPath(double stamp_s, const FloorPath& path);
  void addMap(double stamp_s, const OccupancyGrid& map);
  void addImage(double stamp_s, const cv::Mat& image_bgr);
  /// Whether somebody gets the images: of a bag, always.
  bool isImageWatched() const;

  /// Completes the bag and gives it its name.
  void commit(bool complete) { bag_->commit(complete); }

 private:
  HeaderMsg header(double stamp_s) const;

  std::filesystem::path path_;
  std::string frame_;
  std::unique_ptr<BagWriter> bag_;
};

}  // namespace heel
