// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/film/video_writer.hpp>
#include <heel/apps/follower/learn_person.hpp>
#include <heel/apps/heel/commands.hpp>
#include <heel/apps/heel/shared/arguments.hpp>
#include <heel/apps/heel/shared/robot_places.hpp>
#include <heel/apps/heel/shared/terminal.hpp>
#include <heel/apps/output/run_end.hpp>
#include <heel/apps/pictures/annotate.hpp>
#include <heel/segmentation/appearance_model_io.hpp>
#include <heel/segmentation/appearance_picture.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

namespace heel {
namespace {

struct LearnOptions {
  std::filesystem::path recording;
  std::filesystem::path out;
  RecordingParams opening;
  LearnPersonParams params;
};

/// The picture that shows who was learned: the frame with most of the person in it.
class BestView {
 public:
  explicit BestView(const CameraSetup& setup) : setup_(setup) {}

  void offer(const Frame& frame, const AcquisitionStep& step) {
    if (step.person < 0 || !step.usable) return;
    const WorldBlob& blob = step.view->blobs[static_cast<std::size_t>(step.person)];
    if (blob.area_m2 <= area_m2_) return;
    area_m2_ = blob.area_m2;
    scene_.image_bgr = frame.image_bgr.clone();
    scene_.mask = step.labels >= AcquisitionStep::kTorso;
    scene_.frame = frame.number;
    scene_.stamp_s = frame.stamp_s;
    DrawnTrack person;
    person.position_m = blob.position_m;
    person.height_m = blob.max_height_m;
    person.is_target = true;
    person.confidence = 1.0;
    scene_.tracks = {person};
  }

  cv::Mat draw() {
    scene_.camera = setup_.camera.left;
    scene_.T_floor_camera = setup_.T_base_camera;
    scene_.state = "learned";
    scene_.reason = "the marked pixels are the person's";
    scene_.tone = Tone::kGood;
    cv::Mat picture;
    annotate(scene_, {}, picture);
    return picture;
  }

 private:
  const CameraSetup& setup_;
  DrawnFrame scene_;
  double area_m2_ = 0.0;
};

constexpr int kFewFrames = 5;  // Of the person: less than a walk across the room shows.

void print(const LearnedPerson& learned) {
  const AcquisitionResult& acquisition = learned.acquisition;
  std::printf("learned the person seen from %.1f to %.1f s; it ended %s%s\n",
              acquisition.first_seen_s, acquisition.last_seen_s,
              acquisition.end == AcquisitionEnd::kNotYet ? "with the recording" : "as ",
              acquisition.end == AcquisitionEnd::kNotYet ? "" : toText(acquisition.end));
  std::printf(
      "  %d frames of the empty room, %d of the person (%.0f %% of those since they came)\n",
      acquisition.empty_frames, acquisition.person_frames, 100.0 * acquisition.confidence());
  std::printf(
      "  band      heights [m]   points     delta   taken of the room  missed of the person\n");
  for (const AppearanceBand& band : learned.model.bands()) {
    std::printf("  %-8s  %.2f to %.2f  %7llu  %8.4f   %9llu %5.1f %%  %12llu %5.1f %%\n",
                band.body.name.c_str(), band.body.min_height_m, band.body.max_height_m,
                static_cast<unsigned long long>(band.person.total()), band.delta(),
                static_cast<unsigned long long>(band.errors().false_positives),
                100.0 * band.errors().false_positive_share,
                static_cast<unsigned long long>(band.errors().false_negatives),
                100.0 * band.errors().false_negative_share);
  }
}

/// "; who says it, and when", if the robot moved while it was looked at; else empty.
std::string whenItMoved(const WhileItStands& standing, const MotionWatch& watch) {
  const auto leaves_s = standing.moved_s() ? standing.moved_s() : watch.leaves_s();
  if (!leaves_s) return {};
  char text[120];
  std::snprintf(text, sizeof text,
                "; %s the robot moves from %.1f s on, and learning needs it to stand",
                standing.moved_s() ? "the odometry says that" : "it seems that",
                *leaves_s - standing.info().first_s);
  return text;
}

/// How much of a recording is read, if the call does not say.
TimeSpan lessonSpan(const LearnOptions& options) {
  constexpr double kWait_s = 105.0;  // for the person to come
  TimeSpan span = options.opening.span;
  const AcquisitionParams& lesson = options.params.acquisition;
  if (std::isfinite(span.to_s)) return span;
  span.to_s = span.from_s + lesson.background_s + kWait_s + lesson.person_s;
  return span;
}

/// "; its first 120 s were read (--to)", if there may be more.
std::string whatWasRead(const TimeSpan& span, const RecordingInfo& info) {
  if (span.from_s == 0.0 && info.duration_s < span.to_s - 1.0) return {};
  char text[80];
  std::snprintf(text, sizeof text, "; it was read from %.0f to %.0f s (--from, --to)", span.from_s,
                std::min(span.to_s, span.from_s + info.duration_s));
  return text;
}

void run(LearnOptions options) {
  options.opening.span = lessonSpan(options);
  const std::string ending = options.out.extension().string();
  if (ending != ".yaml" && ending != ".yml") {
    throw std::invalid_argument(options.out.string() + ": the name of a model ends in .yaml");
  }
  const std::string name = options.out.stem().string();
  Output output({"learn",
                 OutputKind::kFile,
                 options.out,
                 {options.recording},
                 {name + ".png", name + "_view.png"}});
  const CameraSetup setup = findCameraSetup(*openRecording(options.recording, options.opening));
  for (const std::string& warning : setup.warnings) warn(warning);
  const auto recording = openRecording(options.recording, options.opening);
  const RobotPlaces robot(*recording, setup);
  WhileItStands standing(*recording, robot);
  MotionWatch watch(robot, setup);
  BestView best_view(setup);
  ProgressBar progress("learning", recording->info().frame_count);
  const LearnedPerson learned = [&] {
    std::size_t frames = 0;
    try {
      return learnPerson(standing, setup, options.params, [&](const Frame& frame, const auto& s) {
        if (isStopRequested()) throw Stopped("stopped: nobody is learned, and nothing is written");
        ++frames;
        watch.look(frame);
        best_view.offer(frame, s);
        progress.show(frame.number);
      });
    } catch (const Stopped&) {
      throw;
    } catch (const std::runtime_error& error) {
      const std::string moved = whenItMoved(standing, watch);
      if (!moved.empty()) throw std::runtime_error(error.what() + moved);
      if (frames == 0) throw;
      // The recording is good, but nobody is in it.
      throw NothingFound(error.what() + whatWasRead(options.opening.span, recording->info()));
    }
  }();
  for (const SkippedFrame& frame : learned.skipped) warn(frame.reason);
  if (const std::string moved = whenItMoved(standing, watch); !moved.empty()) {
    warn((standing.moved_s() ? "learning ended" : "the model may be of little use") + moved);
  }
  const OutputPath picture = output / (name + ".png");
  const OutputPath view = output / (name + "_view.png");
  writePicture(picture, drawAppearance(learned.model));
  writePicture(view, best_view.draw());
  writeWith(output.file(),
            [&](const std::filesystem::path& file) { saveAppearance(learned.model, file); });
  output.commit();
  print(learned);
  const AcquisitionResult& seen = learned.acquisition;
  if (!seen.was_empty) warn(kWasNotEmpty);
  if (seen.person_frames < kFewFrames || seen.confidence() < 0.5) {
    warn("that is little to learn from: look at " + view.named.string() +
         ", whether it is the person, and whether the room was empty at first");
  }
  const Separability separability = learned.model.separability();
  if (separability.doubt != AppearanceDoubt::kNone) warn(separability.advice);
  std::printf("wrote %s, %s, %s\n", options.out.string().c_str(), picture.named.c_str(),
              view.named.c_str());
}

}  // namespace

void addLearn(CLI::App& app) {
  auto options = std::make_shared<LearnOptions>();
  CLI::App* verb = app.add_subcommand("learn", "Learn who to follow, from a recording");
  verb->footer(
      "Example:\n"
      "  heel learn recordings/kitchen --out person.yaml\n"
      "The robot stands still. The recording begins with the empty room (about 5 s); then the "
      "person\n"
      "to follow enters, alone, and moves about (about 10 s). It ends by itself when the time is "
      "up,\n"
      "the person leaves, a second person comes into view, or odometry or tf says that the robot\n"
      "moves.\n"
      "It reads no further than 2 minutes, unless --to says so.\n"
      "Writes the model, a picture of it, and a picture of who was learned.");
  verb->add_option("RECORDING", options->recording, "folder of a recording, or a bag")->required();
  verb->add_option("--out", options->out, "where to write the model (.yaml)")->required();
  verb->add_option("--background", options->params.acquisition.background_s,
                   "how long the room is empty at the beginning [s]; who comes earlier ends it")
      ->capture_default_str();
  verb->add_option("--person", options->params.acquisition.person_s,
                   "how long to look at the person [s]")
      ->capture_default_str();
  verb->add_option_function<int>(
          "--paper",
          [options](int count) {
            options->params.appearance.model = ColorModel::kPrincipalColors;
            options->params.appearance.principal_colors.count = count;
            options->params.appearance.bands = upperBody();
          },
          "filter by the paper's model with this many principal colours of what is above 1 m; 1 is "
          "the paper's, 0 chooses (default: the ratio of a colour's share to the room's)")
      ->check(CLI::Range(0, 8))
      ->type_name("K");
  addTimeSpan(*verb, options->opening.span);
  addCameraTopics(*verb, options->opening.topics);
  addOdometryTopic(*verb, options->opening.topics);
  verb->callback([options] { run(*options); });
}

}  // namespace heel
