// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

// Not a benchmark: learns by logistic regression what PersonOutline's values say, and so how its
// constants were learned. `outline_fit RECORDING TRACKS.csv ...`, where heel track made the tracks:
// those at people of the recording's truth.csv are people, those far from them things.

#include <heel/apps/experiment/truth_frames.hpp>
#include <heel/apps/follower/camera_setup.hpp>
#include <heel/apps/results/result_files.hpp>
#include <heel/segmentation/person_outline.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <map>
#include <vector>

namespace {

using namespace heel;

struct Sample {
  double value = 0.0;
  bool is_person = false;
};

std::vector<Sample> samplesOf(const std::filesystem::path& folder,
                              const std::filesystem::path& tracks) {
  const TruthFrames truth(folder);
  std::multimap<double, Eigen::Vector2d> places;
  for (const TrackRow& row : readTracks(tracks)) places.emplace(row.stamp_s, row.position_m);
  const auto recording = openRecording(folder);
  const CameraSetup setup = findCameraSetup(*openRecording(folder));
  PersonOutline outline;
  BodyView view{{}, {}, setup.camera.left, setup.T_base_camera, false};
  std::vector<Sample> samples;
  Frame frame;
  while (recording->next(frame)) {
    view.image_bgr = frame.image_bgr;
    const auto [begin, end] = std::pair(places.lower_bound(frame.stamp_s - 1e-3),
                                        places.upper_bound(frame.stamp_s + 1e-3));
    for (auto place = begin; place != end; ++place) {
      double nearest_m = 100.0;
      for (const TruthRow& person : truth.at(frame.number)) {
        nearest_m = std::min(nearest_m, (person.position_m - place->second).norm());
      }
      if (nearest_m > 0.4 && nearest_m < 0.8) continue;
      const auto value = outline.classify(view, place->second);
      if (value) samples.push_back({*value, nearest_m <= 0.4});
    }
  }
  return samples;
}

/// Log odds of a person are slope * (value - undecided), people and things counting the same in
/// all: Newton's method.
void fit(const std::vector<Sample>& samples) {
  double count[2] = {0.0, 0.0};
  for (const Sample& sample : samples) ++count[sample.is_person ? 1 : 0];
  Eigen::Vector2d weights = Eigen::Vector2d::Zero();
  double bits = 0.0;
  for (int step = 0; step < 30; ++step) {
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
    Eigen::Matrix2d hessian = 1e-9 * Eigen::Matrix2d::Identity();
    bits = 1.0;
    for (const Sample& sample : samples) {
      const Eigen::Vector2d x(sample.value, 1.0);
      const double p = 1.0 / (1.0 + std::exp(-weights.dot(x)));
      const double share = 0.5 / count[sample.is_person ? 1 : 0];
      gradient += share * ((sample.is_person ? 1.0 : 0.0) - p) * x;
      hessian += share * p * (1.0 - p) * x * x.transpose();
      bits += share * std::log2(sample.is_person ? p : 1.0 - p);
    }
    weights += hessian.inverse() * gradient;
  }
  std::printf(
      "%.0f people, %.0f things: slope %.2f, undecided at %.2f; a look says %.2f of 1 bit\n",
      count[1], count[0], weights[0], -weights[1] / weights[0], bits);
}

}  // namespace

int main(int count, char** words) {
  if (count < 3 || count % 2 == 0) {
    std::fprintf(stderr, "outline_fit RECORDING TRACKS.csv ...\n");
    return 2;
  }
  try {
    std::vector<Sample> all;
    for (int i = 1; i < count; i += 2) {
      const std::vector<Sample> samples = samplesOf(words[i], words[i + 1]);
      std::printf("%s: ", words[i]);
      fit(samples);
      all.insert(all.end(), samples.begin(), samples.end());
    }
    std::printf("all: ");
    fit(all);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
