// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/results/track_log.hpp>

namespace heel {

TrackSample sampleOf(const FrameRow& frame, const std::vector<TrackRow>& tracks, double pixels) {
  TrackSample sample;
  sample.stamp_s = frame.stamp_s;
  sample.robot = frame.robot;
  sample.state = frame.state;
  sample.reason = frame.reason;
  if (pixels > 0.0) sample.color_share = frame.color_pixels / pixels;
  for (const TrackRow& track : tracks) {
    if (track.is_target) {
      sample.target_m = track.position_m;
      sample.confidence = frame.confidence;
    } else {
      sample.others.push_back({track.track_id, track.position_m, track.status == "confirmed",
                               track.person_probability});
    }
  }
  return sample;
}

}  // namespace heel
