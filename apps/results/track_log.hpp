// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// All that following somebody through a recording leaves to be told, one sample a frame; and how
/// the logs of a recording's pieces are joined.
#pragma once

#include <heel/apps/results/follow_log.hpp>
#include <heel/apps/results/result_files.hpp>

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace heel {

/// A track that is not the target's, in one frame.
struct OtherTrack {
  int id = 0;
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  bool is_seen = true;              ///< False while it goes on by prediction alone.
  double person_probability = 1.0;  ///< That it is a person, not a thing.
};

/// One frame. Places are in the frame of the results; NaN stands for what is not known.
struct TrackSample {
  double stamp_s = 0.0;
  FloorPose robot;                          ///< The base frame.
  std::string state;                        ///< "followed", "coasting", "lost", ...
  std::string reason;                       ///< Why the target is not seen; empty if it is.
  std::optional<Eigen::Vector2d> target_m;  ///< Absent while there is no target.
  double confidence = kNotKnown;            ///< Of the target, in [0, 1].
  double color_share = kNotKnown;           ///< Of the picture's pixels: with the target's colours.
  std::vector<OtherTrack> others;
};

/// @param tracks  The rows of tracks.csv of this frame.
/// @param pixels  Of a picture; 0: not known.
TrackSample sampleOf(const FrameRow& frame, const std::vector<TrackRow>& tracks, double pixels);

/// A whole recording.
struct TrackLog {
  std::string recording;
  std::string layout;                         ///< How it is stored.
  std::string person;                         ///< The model's name.
  std::string frame;                          ///< Whose places they are: "base", or the odometry's.
  bool moves = false;                         ///< The robot does.
  bool complete = true;                       ///< False if the run was stopped.
  std::vector<TrackSample> samples;           ///< In order of time.
  std::vector<Eigen::Vector2d> seen_floor_m;  ///< What the camera sees, in the base frame.
  std::optional<Eigen::AlignedBox2d> bounds_m;  ///< Outside of it nobody is looked for.
  std::vector<FollowSnapshot> stills;
  cv::Mat colors_bgr;                 ///< The model as a picture; may be empty.
  cv::Mat learned_bgr;                ///< Who was learned; may be empty.
  std::vector<std::string> warnings;  ///< Sentences.
  std::size_t skipped = 0;            ///< Frames that were left out.
};

/// What `heel track` writes of a recording, or of a piece of it: in order of time.
struct TrackTables {
  std::vector<FrameRow> frames;
  std::vector<TrackRow> tracks;
};

/// Where one piece's rows end, and those of the next one begin.
struct Seam {
  std::size_t first_frame = 0;  ///< As the next piece counts.
  std::ptrdiff_t shift = 0;     ///< From how it counts to how the whole does.
};

/// Appends what a piece tells of the time after `whole`. A track of it is that of the whole which
/// is nearest in the last frame that both have, if it is there within half a person's width; else
/// its number is a new one.
/// @throws std::invalid_argument  if a piece has no frames, or the next one does not go on after
///                                the whole.
Seam join(TrackTables& whole, TrackTables next);

}  // namespace heel
