// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/film/video_writer.hpp>
#include <heel/apps/follower/depth_images.hpp>
#include <heel/apps/heel/commands.hpp>
#include <heel/apps/heel/shared/arguments.hpp>
#include <heel/apps/heel/shared/drawn_perception.hpp>
#include <heel/apps/heel/shared/map_source.hpp>
#include <heel/apps/heel/shared/robot_places.hpp>
#include <heel/apps/heel/shared/terminal.hpp>
#include <heel/apps/heel/view/scene_picture.hpp>
#include <heel/apps/heel/view/view_scene.hpp>
#include <heel/apps/output/run_end.hpp>
#include <heel/segmentation/appearance_model_io.hpp>

#include <CLI/CLI.hpp>
#include <pcl/common/transforms.h>

#include <cstdio>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace heel {
namespace {

namespace fs = std::filesystem;

struct ViewOptions {
  fs::path recording;
  fs::path model;
  LogMapOptions map;
  fs::path out;
  RecordingParams opening;
  std::size_t pictures = 12;
};

/// Turns frames into scenes; with a model, it looks for the person, too.
class Scenes {
 public:
  Scenes(const CameraSetup& setup, RobotPlaces robot, const std::optional<AppearanceModel>& model)
      : setup_(setup),
        robot_(std::move(robot)),
        depths_(setup.sensor, setup.camera),
        drawn_(setup) {
    if (model) perception_.emplace(setup, *model);
    scene_.drawn.camera = setup.camera.left;
  }

  OccupancyGrid& walls() { return scene_.walls; }

  /// Goes to where the robot was at a frame; false if that is not known, see whyAbsent().
  bool goTo(const Frame& frame) {
    const auto place = robot_.at(frame.stamp_s);
    if (place) place_ = *place;
    return place.has_value();
  }

  const std::string& whyAbsent() const { return robot_.whyAbsent(); }

  /// Follows the person through a frame that is not shown.
  void pass(const Frame& frame) {
    if (perception_) {
      drawn_.of(frame, *perception_, perception_->step(frame, place_), place_.pose);
    }
  }

  const ViewScene& of(const Frame& frame) {
    scene_.marked.clear();
    if (perception_) {
      const PerceptionStep& step = perception_->step(frame, place_);
      scene_.drawn = drawn_.of(frame, *perception_, step, place_.pose);
      mark(step);
    } else {
      scene_.drawn.frame = frame.number;
      scene_.drawn.stamp_s = frame.stamp_s;
      scene_.drawn.T_floor_camera = basePose(place_.pose) * setup_.T_base_camera;
    }
    placePoints(frame);
    return scene_;
  }

 private:
  void mark(const PerceptionStep& step) {
    if (step.mask.empty()) {
      scene_.marked = step.standing;
      return;
    }
    const cv::Mat mask = step.mask.isContinuous() ? step.mask : step.mask.clone();
    for (std::size_t i = 0; i < mask.total(); ++i) {
      if (mask.data[i] != 0) scene_.marked.push_back(static_cast<pcl::index_t>(i));
    }
  }

  void placePoints(const Frame& frame) {
    const auto cloud = pcl::make_shared<ColorCloud>();
    const Eigen::Isometry3d& T_floor_camera = scene_.drawn.T_floor_camera;
    if (frame.cloud != nullptr) {
      pcl::transformPointCloud(*frame.cloud, *cloud, T_floor_camera.matrix().cast<float>());
    } else {
      makeColorCloud(depths_.of(frame), frame.image_bgr, setup_.camera.left, T_floor_camera,
                     *cloud);
    }
    scene_.cloud = cloud;
  }

  CameraSetup setup_;
  RobotPlaces robot_;
  RobotPlace place_;
  DepthImages depths_;
  DrawnPerception drawn_;
  std::optional<Perception> perception_;
  ViewScene scene_;
};

/// Gives the scene of every so many frames to `show`, until it says that that is enough.
/// @return how many frames there were.
std::size_t eachScene(const ViewOptions& options, Scenes& scenes, std::size_t step,
                      const std::function<bool(const ViewScene&, double)>& show) {
  const auto recording = openRecording(options.recording, options.opening);
  Frame frame;
  double last_s = std::numeric_limits<double>::quiet_NaN();
  std::size_t seen = 0;
  while (recording->next(frame)) {
    if (!scenes.goTo(frame)) {
      warn(frame.name + ": " + scenes.whyAbsent());
      continue;
    }
    const double since_s = frame.stamp_s - last_s;
    last_s = frame.stamp_s;
    if (seen++ % step > 0) {
      scenes.pass(frame);
    } else if (!show(scenes.of(frame), since_s)) {
      return seen;
    }
  }
  for (const SkippedFrame& skipped : recording->skipped()) warn(skipped.reason);
  if (seen == 0) throw std::runtime_error(nothingReadMessage(*recording));
  return seen;
}

void showInWindow(const ViewOptions& options, Scenes& scenes, SceneWindow& window) {
  constexpr double kLongest_s = 1.0;  // a gap in the recording is not waited for
  std::printf("close the window (or press q in it) to end\n");
  std::fflush(stdout);
  ViewScene last;
  bool is_open = true;
  eachScene(options, scenes, 1, [&](const ViewScene& scene, double since_s) {
    last = scene;
    is_open = window.show(scene, since_s > 0.0 ? std::min(since_s, kLongest_s) : 0.0);
    return is_open;
  });
  while (is_open) is_open = window.show(last, kLongest_s);
}

void writePictures(const ViewOptions& options, Scenes& scenes, std::size_t frames) {
  std::vector<fs::path> inputs = {options.recording, options.model};
  if (!options.map.map.empty()) inputs.push_back(mapSource(options.map.map));
  Output output({"view", OutputKind::kFolder, options.out, std::move(inputs)});
  const std::size_t step = options.pictures == 0 ? 1 : (frames - 1) / options.pictures + 1;
  ProgressBar progress("viewing", frames);
  cv::Mat picture;
  std::size_t written = 0;
  const std::size_t seen = eachScene(options, scenes, step, [&](const ViewScene& scene, double) {
    drawScene(scene, behindCamera(scene.drawn.T_floor_camera), picture);
    char name[32];
    std::snprintf(name, sizeof name, "view_%06zu.png", scene.drawn.frame);
    writePicture(output / name, picture);
    ++written;
    progress.show(scene.drawn.frame);
    return !isStopRequested();
  });
  output.commit(!isStopRequested());
  std::printf("wrote %zu picture%s of %zu frames to %s\n", written, written == 1 ? "" : "s", seen,
              output.path().c_str());
  if (isStopRequested()) throw Stopped("stopped: there are pictures of the frames until then");
}

void run(const ViewOptions& options) {
  std::optional<AppearanceModel> model;
  if (!options.model.empty()) model = loadAppearance(options.model);
  const CameraSetup setup = findCameraSetup(*openRecording(options.recording, options.opening));
  for (const std::string& warning : setup.warnings) warn(warning);
  RobotPlaces robot(*openRecording(options.recording, options.opening), setup);
  OccupancyGrid walls;
  if (!options.map.map.empty()) {
    const LogMap map = openLogMap(options.map);
    for (const std::string& warning : robot.putOnMap(options.recording, options.opening, map)) {
      warn(warning);
    }
    walls = map.walls->floorGrid();
  }
  Scenes scenes(setup, std::move(robot), model);
  scenes.walls() = std::move(walls);
  if (options.out.empty()) {
    std::string why;
    if (const auto window = openSceneWindow(why)) return showInWindow(options, scenes, *window);
    throw std::invalid_argument(why + "; name a folder for pictures of the same with --out");
  }
  writePictures(options, scenes,
                openRecording(options.recording, options.opening)->info().frame_count);
}

}  // namespace

void addView(CLI::App& app) {
  auto options = std::make_shared<ViewOptions>();
  CLI::App* verb = app.add_subcommand("view", "Show a recording in three dimensions");
  verb->footer(
      "Examples:\n"
      "  heel view recordings/kitchen\n"
      "  heel view recordings/kitchen --model person.yaml --map maps/home/walls.bt\n"
      "  heel view recordings/kitchen --model person.yaml --out pictures\n"
      "Shows the cloud of each frame; with a model, also the points of the person's colours, the\n"
      "blobs on the floor, and the tracks as poles (the target's is orange). If the robot moves,\n"
      "all of it is in the frame of its odometry; with a map, in the map's. Opens a window, or "
      "with\n"
      "--out writes pictures of the same.");
  verb->add_option("RECORDING", options->recording, "folder of a recording, a bag, or a PCD file")
      ->required();
  verb->add_option("--model", options->model, "the person, as 'heel learn' wrote it");
  verb->add_option("--map", options->map.map,
                   "walls to show, on which the robot is found by its laser and odometry, or by "
                   "tf's frame 'map': whatever 'heel map' takes or wrote");
  addLogMap(*verb, options->map, options->opening.topics);
  verb->add_option("--out", options->out,
                   "write pictures to this folder, and open no window; needs no display");
  verb->add_option("--pictures", options->pictures, "how many at the most; 0: one of each frame")
      ->capture_default_str();
  addTimeSpan(*verb, options->opening.span);
  addCameraTopics(*verb, options->opening.topics);
  addOdometryTopic(*verb, options->opening.topics);
  verb->callback([options] { run(*options); });
}

}  // namespace heel
