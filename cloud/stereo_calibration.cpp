// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/image_extent.hpp>
#include <heel/cloud/stereo_calibration.hpp>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>

namespace heel {

namespace fs = std::filesystem;

std::vector<fs::path> stereoRigFiles(const fs::path& path) {
  if (!fs::exists(path))
    throw std::runtime_error(path.string() + ": there is no such file or folder");
  if (!fs::is_directory(path)) return {path};
  for (const char* ending : {".yaml", ".yml"}) {
    const auto left = path / (std::string("left") + ending);
    const auto right = path / (std::string("right") + ending);
    if (fs::exists(left) || fs::exists(right)) return {left, right};
  }
  for (const char* ending : {".yml", ".yaml", ".xml"}) {
    const auto extrinsics = path / (std::string("extrinsics") + ending);
    if (fs::exists(extrinsics)) return {path / (std::string("intrinsics") + ending), extrinsics};
  }
  for (const char* name : {"calib", "stereo", "calibration"}) {
    for (const char* ending : {".yaml", ".yml", ".xml", ".json"}) {
      const auto file = path / (std::string(name) + ending);
      if (fs::exists(file)) return {file};
    }
  }
  if (fs::exists(path / "calib.txt")) return {path / "calib.txt"};
  throw std::runtime_error(
      path.string() +
      ": it holds no calibration (left.yaml and right.yaml, intrinsics.yml and extrinsics.yml, "
      "calib.yaml, stereo.yaml, calib.txt)");
}

StereoRig readStereoRig(const fs::path& path, cv::Size image_size) {
  const std::vector<fs::path> files = stereoRigFiles(path);
  if (files.front().extension() == ".txt") return readMiddleburyCalibration(files.front());
  if (files.size() == 2 && files.front().stem() == "left") {
    return readCameraInfo(files.front(), files.back());
  }
  return readOpenCvCalibration(files, image_size);
}

namespace {

[[noreturn]] void failFile(const fs::path& file, const std::string& reason) {
  throw std::runtime_error(file.string() + ": " + reason);
}

std::string trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(" \t\r");
  const auto end = text.find_last_not_of(" \t\r");
  return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
}

/// The `count` numbers of a line `key=1` or `key=[1 2 3; 4 5 6; 7 8 9]`.
std::vector<double> numbers(const fs::path& file, const std::map<std::string, std::string>& lines,
                            const std::string& key, std::size_t count) {
  const auto line = lines.find(key);
  if (line == lines.end()) failFile(file, key + " is missing");
  std::string text = line->second;
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '[' || c == ']' || c == ';'; }, ' ');
  std::istringstream stream(text);
  std::vector<double> values;
  for (double value = 0.0; stream >> value;) values.push_back(value);
  if (values.size() != count)
    failFile(file, key + " has not " + std::to_string(count) + " numbers");
  return values;
}

}  // namespace

StereoRig readMiddleburyCalibration(const fs::path& file) {
  std::ifstream stream(file);
  if (!fs::is_regular_file(file) || !stream) failFile(file, "there is no such file");
  std::map<std::string, std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    const auto equals = line.find('=');
    if (equals != std::string::npos) {
      lines[trimmed(line.substr(0, equals))] = trimmed(line.substr(equals + 1));
    }
  }
  const auto K = numbers(file, lines, "cam0", 9);
  const double width = numbers(file, lines, "width", 1)[0];
  const double height = numbers(file, lines, "height", 1)[0];
  checkCameraMemory(file.string(), width, height);
  StereoCamera camera;
  camera.left = {static_cast<int>(width), static_cast<int>(height), K[0], K[4], K[2], K[5]};
  camera.baseline_m = numbers(file, lines, "baseline", 1)[0] / 1000.0;
  camera.disparity_offset = numbers(file, lines, "doffs", 1)[0];
  if (!(camera.baseline_m > 0.0)) failFile(file, "there is no baseline between the cameras");
  if (!(camera.left.fx > 0.0)) failFile(file, "a focal length is not positive");
  return StereoRig(camera);
}

}  // namespace heel
