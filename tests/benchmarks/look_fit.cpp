// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

// Not a benchmark: learns by logistic regression how looks at people count, and so how constants of
// gallery.hpp were learned. `look_fit MODEL RECORDING FROM_S PERSON ...`, where PERSON of the
// recording's truth.csv is whom heel learn made the model of, from elsewhere or from before FROM_S.

#include <heel/apps/experiment/truth_frames.hpp>
#include <heel/apps/follower/camera_setup.hpp>
#include <heel/segmentation/appearance_model_io.hpp>
#include <heel/tracking/gallery.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

namespace {

using namespace heel;

/// A look at somebody in view.
struct Sample {
  bool is_right = false;  // It is whom the model was made of.
  double likeness = 0.0;  // Of all parts, and what the light says.
  std::vector<double> misfits;
};

std::vector<Sample> samplesOf(const std::filesystem::path& model_file,
                              const std::filesystem::path& folder, double from_s,
                              const std::string& person) {
  const TruthFrames truth(folder);
  const auto recording = openRecording(folder);
  const AppearanceModel model = loadAppearance(model_file);
  Perception perception(findCameraSetup(*openRecording(folder)), model);
  Gallery gallery(looksOf(model));
  LookEvidence evidence;
  std::vector<Sample> samples;
  Frame frame;
  while (recording->next(frame)) {
    for (const Observation& seen : perception.step(frame).observations) {
      std::vector<std::string> there;
      for (const TruthRow& row : truth.at(frame.number)) {
        if ((row.position_m - seen.position_m).norm() < 0.4) there.push_back(row.person);
      }
      if (frame.stamp_s < from_s || there.size() != 1 || seen.look == nullptr) continue;
      gallery.compare(seen, evidence);
      Sample sample{there.front() == person, evidence.light[kTarget], {}};
      for (Eigen::Index part = 0; part < evidence.parts.cols(); ++part) {
        const double misfit = evidence.misfits(kTarget, part);
        if (misfit < 0.0) continue;
        sample.likeness += evidence.parts(kTarget, part) - kLikenessOffset;
        sample.misfits.push_back(misfit);
      }
      if (!sample.misfits.empty()) samples.push_back(sample);
    }
  }
  return samples;
}

/// Log odds of the right person are likeness + offset * parts: Newton's method.
void fit(const std::vector<Sample>& samples) {
  double count[2] = {0.0, 0.0}, parts[2] = {0.0, 0.0}, misfit[2] = {0.0, 0.0};
  for (const Sample& sample : samples) {
    ++count[sample.is_right ? 1 : 0];
    for (const double value : sample.misfits) {
      ++parts[sample.is_right ? 1 : 0];
      misfit[sample.is_right ? 1 : 0] += value;
    }
  }
  double offset = kLikenessOffset, mean = 0.0;
  for (int step = 0; step < 30; ++step) {
    double gradient = 0.0, hessian = 1e-9;
    mean = 0.0;
    for (const Sample& sample : samples) {
      const auto x = static_cast<double>(sample.misfits.size());
      const double p = 1.0 / (1.0 + std::exp(-sample.likeness - offset * x));
      gradient += ((sample.is_right ? 1.0 : 0.0) - p) * x;
      hessian += p * (1.0 - p) * x * x;
      mean += std::log(std::max(sample.is_right ? p : 1.0 - p, 1e-12)) / (count[0] + count[1]);
    }
    offset += std::clamp(gradient / hessian, -0.2, 0.2);
  }
  std::printf(
      "%.0f looks at the right person, %.0f at others: offset %.2f, mean log likelihood %.3f; "
      "misfits %.2f of %.0f parts, and %.2f of %.0f\n",
      count[1], count[0], offset, mean, misfit[1] / parts[1], parts[1], misfit[0] / parts[0],
      parts[0]);
}

}  // namespace

int main(int count, char** words) {
  if (count < 5 || count % 4 != 1) {
    std::fprintf(stderr, "look_fit MODEL RECORDING FROM_S PERSON ...\n");
    return 2;
  }
  try {
    std::vector<Sample> all;
    for (int i = 1; i < count; i += 4) {
      const std::vector<Sample> samples =
          samplesOf(words[i], words[i + 1], std::stod(words[i + 2]), words[i + 3]);
      all.insert(all.end(), samples.begin(), samples.end());
    }
    fit(all);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
