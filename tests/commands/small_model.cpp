// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/commands/small_model.hpp"

#include "tests/commands/small_recording.hpp"
#include <heel/segmentation/appearance_model_io.hpp>

#include <opencv2/core.hpp>

namespace heel::test {

namespace {

/// A colour as the small recording shows it, with its noise.
void add(const cv::Vec3b& bgr, ColorHistogram& colors) {
  for (int noise = -9; noise <= 9; ++noise) {
    const auto shade = [&](int channel) {
      return cv::saturate_cast<std::uint8_t>(bgr[channel] + noise);
    };
    colors.add({shade(0), shade(1), shade(2)}, 100);
  }
}

}  // namespace

void writeSmallModel(const std::filesystem::path& file) {
  ColorHistogram jumper, room;
  add(SmallRecording::kJumper, jumper);
  add(SmallRecording::kWall, room);
  add(SmallRecording::kFloor, room);
  AppearanceParams params;
  params.bands = {{"jumper", 1.0, 1.5}};  // The face is not learned.
  saveAppearance(AppearanceModel(params, {jumper}, room), file);
}

}  // namespace heel::test
