// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/camera/camera_recording.hpp>
#include <heel/apps/follower/perception.hpp>
#include <heel/apps/heel/commands.hpp>
#include <heel/apps/heel/live/live_camera.hpp>
#include <heel/apps/heel/live/live_tellers.hpp>
#include <heel/apps/heel/live/picture_stream.hpp>
#include <heel/apps/heel/shared/drawn_perception.hpp>
#include <heel/apps/output/run_end.hpp>
#include <heel/segmentation/appearance_model_io.hpp>

#include <cstddef>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace heel {

void watchCamera(const LiveCameraOptions& options) {
  const AppearanceModel model = loadAppearance(options.model);
  CameraRecording camera(options.camera);
  PictureStream stream(options.port);
  keepResultsOnSignals();
  const CameraSetup setup = findCameraSetup(camera);
  for (const std::string& warning : setup.warnings) warn(warning);
  Perception perception(setup, model);
  DrawnPerception drawn(setup);
  StateTeller teller;
  std::fprintf(stderr, "heel: pictures are at %s (Ctrl-C ends it)\n", stream.url().c_str());

  std::size_t frames = 0, with_target = 0, left_out = 0;
  Frame frame;
  cv::Mat picture;
  while (!isStopRequested() && camera.next(frame) && frame.stamp_s <= options.limit_s) {
    try {
      const PerceptionStep& step = perception.step(frame, {});
      ++frames;
      if (step.target.hasPlace()) ++with_target;
      teller.tell(toText(step.target.status), step.reason, frame.stamp_s);
      const DrawnFrame& scene = drawn.of(frame, perception, step);
      if (!stream.isWatched()) continue;
      annotate(scene, {}, picture);
      stream.show(picture);
    } catch (const std::invalid_argument&) {
      ++left_out;
    }
  }
  std::printf("%zu pictures, the target seen or predicted in %zu", frames, with_target);
  if (left_out > 0) std::printf("; %zu left out", left_out);
  std::printf("\n");
  if (with_target == 0) throw NothingFound(camera.info().name + ": the person was not seen");
}

}  // namespace heel
