// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/experiments.hpp>
#include <heel/apps/experiment/truth_frames.hpp>
#include <heel/apps/follower/depth_images.hpp>
#include <heel/apps/follower/people_detector.hpp>

#include <map>

namespace heel {

ClearMot runDetectorExperiment(const std::filesystem::path& path, const ExperimentParams& params,
                               const WorkTimer& timer) {
  const TruthFrames truth(path);
  const CameraSetup setup = findCameraSetup(*openRecording(path));
  const auto recording = openRecording(path);
  DepthImages depths(setup.sensor, setup.camera);
  PeopleDetector detector(setup.camera.left, setup.T_base_camera);
  BackgroundLearner learner;
  BackgroundModel background;
  std::map<std::string, int> ids;
  std::vector<TrackingFrame> frames;
  Frame frame;
  while (recording->next(frame)) {
    const cv::Mat& depth_m = depths.of(frame);
    if (frame.stamp_s <= params.background_s) {
      learner.add(frame.image_bgr, depth_m);
      continue;
    }
    if (background.empty()) background = learner.model();
    timer.start();
    const PeopleView& view = detector.detect(background, frame.image_bgr, depth_m);
    timer.stop();
    TrackingFrame& seen = frames.emplace_back();
    for (const TruthRow& row : truth.at(frame.number)) {
      const int id = ids.emplace(row.person, static_cast<int>(ids.size())).first->second;
      seen.truth.push_back({id, row.position_m});
    }
    for (const int person : view.people) {
      const auto& blob = view.blobs[static_cast<std::size_t>(person)];
      seen.estimates.push_back({static_cast<int>(seen.estimates.size()), blob.position_m});
    }
  }
  ClearMotParams metrics;
  metrics.match_distance_m = kDetectorDistance_m;
  metrics.has_identity = false;
  return clearMot(frames, metrics);
}

}  // namespace heel
