// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/light_experiment.hpp>
#include <heel/apps/experiment/truth_frames.hpp>
#include <heel/apps/simulation/color.hpp>

#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace heel {
namespace {

/// One person in the second half of their exact frames.
TargetMetrics lookFor(const std::string& person, const AppearanceModel& model,
                      const std::filesystem::path& path, const CameraSetup& setup,
                      const TruthFrames& truth, const cv::Mat& levels, double distance_m) {
  const auto exact = truth.exactFrames(person);
  const std::set<std::size_t> judged(exact.begin() + static_cast<std::ptrdiff_t>(exact.size() / 2),
                                     exact.end());
  Perception perception(setup, model);
  std::vector<TargetFrame> frames;
  const auto recording = openRecording(path);
  Frame frame;
  while (recording->next(frame) && frame.number <= *judged.rbegin()) {
    if (frame.number < *judged.begin()) continue;
    changeLight(frame, levels);
    const TargetEstimate& target = perception.step(frame).target;
    if (judged.count(frame.number) == 0) continue;
    frames.push_back(truth.targetFrame(person, frame.number, frame.stamp_s));
    if (target.hasPlace()) frames.back().estimate_m = target.motion.position_m();
  }
  return targetMetrics(frames, distance_m);
}

}  // namespace

cv::Mat levelsAfter(const LightChange& change) {
  const double exposure = std::exp2(change.stops);
  const double red = std::sqrt(1.0 + change.red_against_blue);
  cv::Mat levels(1, 256, CV_8UC3);
  for (int i = 0; i < 256; ++i) {
    const double light = exposure * toLinear(static_cast<float>(i) / 255.0F);
    const auto level = [&](double gain) {
      const double display = toDisplay(static_cast<float>(std::min(light * gain, 1.0)));
      return static_cast<std::uint8_t>(std::lround(255.0 * display));
    };
    levels.at<cv::Vec3b>(i) = {level(1.0 / red), level(1.0), level(red)};
  }
  return levels;
}

void changeLight(Frame& frame, const cv::Mat& levels) {
  if (frame.image_bgr.empty()) throw std::invalid_argument("changeLight: there is no image");
  for (cv::Mat* image : {&frame.image_bgr, &frame.right_bgr}) {
    if (image->empty()) continue;
    cv::Mat changed;  // Others may hold the image.
    cv::LUT(*image, levels, changed);
    *image = changed;
  }
}

std::vector<LightChange> changesOfLight() {
  std::vector<LightChange> changes;
  for (const double stops : {-1.0, 0.0, 1.0}) {
    for (const double balance : {-0.3, 0.0, 0.3}) changes.push_back({stops, balance});
  }
  return changes;
}

LightRun runLightExperiment(std::uint64_t seed, const PerceptionTruthParams& params) {
  const PerceptionTrial trial = makePerceptionTrial(seed, params);
  PerceptionParams perception_params = params.perception;
  perception_params.gate = trial.recording.gate;
  LightRun run;
  for (const LightChange& change : changesOfLight()) {
    const cv::Mat levels = levelsAfter(change);
    Perception perception(trial.recording.setup, trial.model, perception_params);
    std::vector<TargetFrame> frames;
    for (const SimulatedFrame& now : trial.recording.frames) {
      Frame seen = now.frame;
      changeLight(seen, levels);
      frames.push_back(targetFrame(now, perception.step(seen).target));
    }
    run.push_back(targetMetrics(frames, kPlaceError_m));
  }
  return run;
}

LightRun runLightExperiment(const std::filesystem::path& path, const ExperimentParams& params) {
  const TruthFrames truth(path);
  const CameraSetup setup = findCameraSetup(*openRecording(path));
  const auto lessons = learnEveryone(path, setup, truth, {{"", params.appearance}}, params);
  std::vector<cv::Mat> levels;
  for (const LightChange& change : changesOfLight()) levels.push_back(levelsAfter(change));
  LightRun run(levels.size());
  for (std::size_t i = 0; i < lessons.size(); ++i) {
    const std::string& person = truth.people()[i];
    const auto model = lessons[i].learn(0);
    if (!model) throw std::runtime_error(person + ": nothing of them could be learned");
    for (std::size_t k = 0; k < run.size(); ++k) {
      run[k].add(lookFor(person, *model, path, setup, truth, levels[k], kTrackerDistance_m));
    }
  }
  return run;
}

void add(LightRun& sum, const LightRun& run) {
  sum.resize(run.size());
  for (std::size_t i = 0; i < run.size(); ++i) sum[i].add(run[i]);
}

}  // namespace heel
