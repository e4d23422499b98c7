// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/film/video_writer.hpp>
#include <heel/apps/output/csv_file.hpp>
#include <heel/apps/recording/bags/sensor_bag.hpp>
#include <heel/apps/results/result_files.hpp>
#include <heel/apps/simulation/recording_writer.hpp>

#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/core/persistence.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <stdexcept>
#include <utility>
#include <vector>

namespace heel {
namespace {

namespace fs = std::filesystem;

constexpr double kDepthSteps = 10000.0;  // Of a metre, in 16-bit pictures.

__attribute__((format(printf, 1, 2))) std::string format(const char* pattern, ...) {
  std::array<char, 400> text{};
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(text.data(), text.size(), pattern, arguments);
  va_end(arguments);
  return text.data();
}

cv::Mat packedDepth(const cv::Mat& depth_m) {
  cv::Mat packed(depth_m.size(), CV_16UC1);
  std::transform(depth_m.begin<float>(), depth_m.end<float>(), packed.begin<std::uint16_t>(),
                 [](float z) {
                   const double steps = std::round(static_cast<double>(z) * kDepthSteps);
                   return steps > 0.0 && steps < 65536.0 ? static_cast<std::uint16_t>(steps)
                                                         : std::uint16_t{0};
                 });
  return packed;
}

}  // namespace

RecordingWriter::RecordingWriter(const fs::path& folder, const Simulator& simulator)
    : output_({"simulate", OutputKind::kFolder, folder, {}, {}, true}),
      camera_(simulator.camera()),
      T_base_camera_(asInBags(simulator.T_base_camera())) {
  writeCameraFiles(simulator);
}

RecordingWriter::~RecordingWriter() {
  try {
    encoding_.wait();
  } catch (const std::exception&) {
    // Whoever gave up before finish() has been told why.
  }
}

void RecordingWriter::writeCameraFiles(const Simulator& simulator) {
  const PinholeCamera& c = camera_.left;
  const cv::Matx34d P1(c.fx, 0, c.cx, 0, 0, c.fy, c.cy, 0, 0, 0, 1, 0);
  cv::Matx34d P2 = P1;
  P2(0, 3) = -c.fx * camera_.baseline_m;
  cv::FileStorage stereo(".yaml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
  stereo << "image_width" << c.width << "image_height" << c.height;
  stereo << "P1" << cv::Mat(P1) << "P2" << cv::Mat(P2);
  writeFile(output_ / "stereo.yaml", stereo.releaseAndGetString());

  std::string camera =
      "# The left camera, rectified. Ground frame: the robot's base at the start (X forward, "
      "Y left, Z up).\n" +
      format("width: %d\nheight: %d\nfx: %.9g\nfy: %.9g\ncx: %.9g\ncy: %.9g\nrate_hz: %.9g\n",
             c.width, c.height, c.fx, c.fy, c.cx, c.cy, simulator.scene().robot.camera.rate_hz) +
      format("baseline_m: %.9g\n", camera_.baseline_m) + "T_ground_camera: [";
  for (int i = 0; i < 16; ++i) {
    camera += format("%s%.17g", i == 0 ? "" : ", ", T_base_camera_.matrix()(i / 4, i % 4));
  }
  writeFile(output_ / "camera.yaml", camera + "]\n");
}

OutputFile& RecordingWriter::table(const std::string& name, const std::string& header) {
  const auto found = tables_.find(name);
  if (found != tables_.end()) return found->second;
  OutputFile& file = tables_.try_emplace(name, output_ / name).first->second;
  if (!header.empty()) file.write(header + '\n');
  return file;
}

void RecordingWriter::writeLine(const std::string& name, const std::string& header,
                                const std::string& line) {
  table(name, header).write(line + '\n');
}

void RecordingWriter::writeImage(const std::string& folder, const cv::Mat& image) {
  // Without a level OpenCV takes its fastest, which is also the smaller for noisy pictures.
  encoding_.run([file = output_ / (folder + format("/%06zu.png", frames_)), image] {
    writePicture(file, image);
  });
}

void RecordingWriter::add(const Readings& readings) {
  stamp_s_ = readings.stamp_s;
  if (frames_ == 0) T_ground_world_ = basePose(readings.truth.robot).inverse();
  if (readings.stereo != nullptr) addFrame(readings);
  addTruth(readings);
  if (readings.laser != nullptr) {
    std::string line = format("%.3f,%.6f,%.8f", readings.stamp_s, readings.laser->first_rad,
                              readings.laser->step_rad);
    for (const float range : readings.laser->ranges_m) line += format(",%.4f", range);
    writeLine("scan.csv", "stamp_s,first_rad,step_rad,ranges_m", line);
  }
  if (readings.odometry) {
    const FloorPose& pose = *readings.odometry;
    writeLine("odometry.csv", "stamp_s,x_m,y_m,yaw_rad",
              format("%.3f,%.5f,%.5f,%.6f", readings.stamp_s, pose.position.x(), pose.position.y(),
                     pose.yaw_rad));
  }
}

void RecordingWriter::addFrame(const Readings& readings) {
  encoding_.wait();
  ++frames_;
  const StereoReading& stereo = *readings.stereo;
  writeLine("times.txt", "", format("%.3f", readings.stamp_s));
  writeImage("left", stereo.left_bgr.clone());
  writeImage("right", stereo.right_bgr.clone());
  writeImage("truth/depth", packedDepth(stereo.depth_m));
  writeImage("truth/people", stereo.people.clone());
  std::array<int, 256> seen{};
  for (auto it = stereo.people.begin<std::uint8_t>(); it != stereo.people.end<std::uint8_t>(); ++it)
    ++seen[*it];
  const std::string header = "stamp_s,frame,person,x_m,y_m,exact";
  table("truth.csv", header);
  table("truth_map.csv", header);
  for (std::size_t i = 0; i < readings.truth.people.size() && i + 1 < seen.size(); ++i) {
    const PersonTruth& person = readings.truth.people[i];
    const Eigen::Vector3d in_world(person.position.x(), person.position.y(), 1.0);
    const Eigen::Isometry3d T_camera_world =
        T_base_camera_.inverse() * basePose(readings.truth.robot).inverse();
    const double depth_m = std::max((T_camera_world * in_world).z(), 0.3);
    const double body_px = 0.55 * camera_.left.fx * camera_.left.fy / (depth_m * depth_m);
    const double share = seen[i + 1] / body_px;
    if (seen[i + 1] < 12 || share < 0.05) continue;
    const Eigen::Vector3d place =
        T_ground_world_ * Eigen::Vector3d(in_world.x(), in_world.y(), 0.0);
    for (const auto& [name, at] : {std::pair("truth.csv", Eigen::Vector2d(place.head<2>())),
                                   std::pair("truth_map.csv", Eigen::Vector2d(person.position))}) {
      writeLine(name, header,
                format("%.3f,%zu,", readings.stamp_s, frames_) + csvText(person.name) +
                    format(",%.4f,%.4f,%d", at.x(), at.y(), share >= 0.25 ? 1 : 0));
    }
  }
}

void RecordingWriter::addTruth(const Readings& readings) {
  const WorldTruth& truth = readings.truth;
  for (const PersonTruth& person : truth.people) {
    writeLine("people.csv", "stamp_s,person,x_m,y_m,yaw_rad,vx_mps,vy_mps",
              format("%.3f,", readings.stamp_s) + csvText(person.name) +
                  format(",%.4f,%.4f,%.4f,%.4f,%.4f", person.position.x(), person.position.y(),
                         person.yaw_rad, person.velocity.x(), person.velocity.y()));
  }
  writeLine(
      "robot.csv", "stamp_s,x_m,y_m,yaw_rad,forward_mps,turn_radps,clearance_m,contact",
      format("%.3f,%.5f,%.5f,%.6f,%.4f,%.4f,%.4f,%d", readings.stamp_s, truth.robot.position.x(),
             truth.robot.position.y(), truth.robot.yaw_rad, truth.robot_speed.forward_mps,
             truth.robot_speed.turn_radps, truth.clearance_m, truth.contact ? 1 : 0));
}

void RecordingWriter::finish(bool complete) {
  encoding_.wait();
  for (auto& [name, file] : tables_) file.close();
  writeJson(output_ / "summary.json",
            {{"complete", complete}, {"frames", frames_}, {"duration_s", stamp_s_}});
  output_.commit(complete);
}

}  // namespace heel
