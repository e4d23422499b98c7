// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/perception_truth_experiment.hpp>
#include <heel/apps/experiment/simulated_frames.hpp>
#include <heel/apps/simulation/random.hpp>

#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace heel {
namespace {

constexpr std::uint8_t kTarget = 1;  // Of the instance mask: the scene's first person.

double shareOf(std::int64_t part, std::int64_t whole) {
  if (whole == 0) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(part) / static_cast<double>(whole);
}

/// Heights over the floor of one pixel after the other.
class TrueHeights {
 public:
  explicit TrueHeights(const CameraSetup& setup)
      : camera_(setup.camera.left), T_(setup.T_base_camera) {}

  /// NaN where the depth is.
  double at(int u, int v, float depth_m) const {
    return (T_ * Eigen::Vector3d(rayOf(camera_, u, v) * static_cast<double>(depth_m))).z();
  }

 private:
  PinholeCamera camera_;
  Eigen::Isometry3d T_;
};

/// @param passed  CV_8UC1, not 0 where the stage lets pass.
void count(const cv::Mat& passed, const SimulatedFrame& now, const TrueHeights& heights,
           const std::vector<BodyBand>& bands, PixelCount& result) {
  for (int v = 0; v < passed.rows; ++v) {
    const auto* mask = passed.ptr<std::uint8_t>(v);
    const auto* people = now.people.ptr<std::uint8_t>(v);
    const auto* depth = now.true_depth_m.ptr<float>(v);
    for (int u = 0; u < passed.cols; ++u) {
      result.passed += mask[u] != 0 ? 1 : 0;
      if (people[u] != kTarget) continue;
      result.on_target += mask[u] != 0 ? 1 : 0;
      const double height_m = heights.at(u, v, depth[u]);
      bool known = false;
      for (const BodyBand& band : bands) known = known || band.contains(height_m);
      if (!known) continue;
      ++result.wanted;
      result.found += mask[u] != 0 ? 1 : 0;
    }
  }
}

}  // namespace

double PixelCount::precision() const { return shareOf(on_target, passed); }
double PixelCount::recall() const { return shareOf(found, wanted); }

void PixelCount::add(const PixelCount& other) {
  passed += other.passed;
  on_target += other.on_target;
  wanted += other.wanted;
  found += other.found;
}

PerceptionTrial makePerceptionTrial(std::uint64_t seed, const PerceptionTruthParams& params) {
  const Wardrobe wardrobe = randomWardrobe(seed);
  const WardrobeRooms rooms(params.scenes, seed);
  const bool similar = seed % 5 == 0;
  const ScenePerson& target = wardrobe.people[similar ? 0 : 2];
  const ScenePerson& other = wardrobe.people[similar ? 1 : 3];
  AppearanceModel model =
      learnInWardrobe(rooms, target, params.appearance, params.perception.stereo, params.empty_s,
                      params.person_s, hashOf(seed, 21));
  SimulatedFramesParams span;
  span.seed = hashOf(seed, 22);
  span.to_s = params.follow_s;
  return {similar, std::move(model), renderFrames(rooms.trial({target, other}, span.seed), span)};
}

PerceptionTruthRun runPerceptionTruthExperiment(std::uint64_t seed,
                                                const PerceptionTruthParams& params) {
  const auto [similar, model, recording] = makePerceptionTrial(seed, params);
  PerceptionTruthRun run;
  run.seed = seed;
  run.similar = similar;
  PerceptionParams perception_params = params.perception;
  perception_params.gate = recording.gate;
  Perception perception(recording.setup, model, perception_params);
  const TrueHeights heights(recording.setup);
  std::vector<TargetFrame> target_frames;
  std::vector<TrackingFrame> mot_frames;
  cv::Mat standing;
  for (const SimulatedFrame& now : recording.frames) {
    const PerceptionStep& step = perception.step(now.frame);
    count(step.mask, now, heights, model.params().bands, run.filter);
    standing.create(step.mask.size(), CV_8UC1);
    standing.setTo(0);
    for (const pcl::index_t i : step.standing) standing.data[i] = 255;
    count(standing, now, heights, model.params().bands, run.standing);

    const TargetFrame& frame = target_frames.emplace_back(targetFrame(now, step.target));
    TrackingFrame& mot = mot_frames.emplace_back();
    if (frame.target_m) mot.truth.push_back({0, *frame.target_m});
    if (frame.estimate_m) mot.estimates.push_back({step.target.track_id, *frame.estimate_m});
  }
  run.target = targetMetrics(target_frames, kPlaceError_m);
  ClearMotParams mot_params;
  mot_params.match_distance_m = kPlaceError_m;
  run.mot = clearMot(mot_frames, mot_params);
  return run;
}

PerceptionTruthRun sumOf(const std::vector<PerceptionTruthRun>& runs) {
  PerceptionTruthRun sum;
  for (const PerceptionTruthRun& run : runs) {
    sum.filter.add(run.filter);
    sum.standing.add(run.standing);
    sum.target.add(run.target);
    sum.mot.frames += run.mot.frames;
    sum.mot.truths += run.mot.truths;
    sum.mot.matches += run.mot.matches;
    sum.mot.misses += run.mot.misses;
    sum.mot.false_positives += run.mot.false_positives;
    sum.mot.mismatches += run.mot.mismatches;
    sum.mot.distance_sum_m += run.mot.distance_sum_m;
  }
  return sum;
}

}  // namespace heel
