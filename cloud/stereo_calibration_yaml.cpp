// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The calibrations that are named values: OpenCV's (YAML, JSON or XML) and ROS's (YAML).
///
/// cv::FileStorage is not used: on foreign files it loops without an end, or crashes.

#include <heel/cloud/files.hpp>
#include <heel/cloud/stereo_calibration.hpp>

#include <opencv2/calib3d.hpp>
#include <pugixml.hpp>
#include <yaml-cpp/yaml.h>

#include <cctype>
#include <initializer_list>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace heel {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& origin, const std::string& reason) {
  throw std::runtime_error(origin + ": " + reason);
}

std::string readText(const fs::path& file) {
  constexpr std::size_t kMostBytes = std::size_t{1}
                                     << 20U;  // YAML takes some hundred times as much
  if (!fs::is_regular_file(file)) fail(file.string(), "there is no such file");
  if (fs::file_size(file) > kMostBytes) {
    fail(file.string(), "it is too large for a calibration (over 1 MiB)");
  }
  return readWholeFile(file);
}

/// The map at the top of a YAML file.
YAML::Node readYaml(const fs::path& file, const std::string& text) {
  YAML::Node root;
  try {
    root = YAML::Load(text);
  } catch (const YAML::Exception& error) {
    fail(file.string(), "it is not YAML (line " + std::to_string(error.mark.line + 1) + ")");
  }
  if (!root.IsMap()) fail(file.string(), "it holds no named values");
  return root;
}

// --- OpenCV -------------------------------------------------------------------------------------

/// Names are compared without case, `_` and `-`.
std::string plainName(const std::string& name) {
  std::string plain;
  for (const char c : name) {
    if (c != '_' && c != '-') {
      plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
  }
  return plain;
}

/// A matrix, or numbers without a shape, or neither: then it is empty.
struct StoredValue {
  std::string name;
  int rows = 0;
  int cols = 0;
  std::vector<double> numbers;
};

StoredValue storedValue(const std::string& name, const YAML::Node& node) {
  StoredValue value;
  value.name = name;
  try {
    if (node.IsMap()) {
      value.rows = node["rows"].as<int>();
      value.cols = node["cols"].as<int>();
      value.numbers = node["data"].as<std::vector<double>>();
      if (node["dt"].as<std::string>() == "f") {
        for (double& number : value.numbers) number = static_cast<float>(number);
      }
    } else if (node.IsSequence()) {
      value.numbers = node.as<std::vector<double>>();
    } else {
      value.numbers = {node.as<double>()};
    }
  } catch (const YAML::Exception&) {
    value.numbers.clear();  // such as a date: of interest only if it is asked for
  }
  return value;
}

/// XML's words as the list, or the single value, that they are in YAML.
YAML::Node wordsOf(const pugi::xml_node& element) {
  YAML::Node list(YAML::NodeType::Sequence);
  std::istringstream words(element.text().get());
  for (std::string word; words >> word;) list.push_back(word);
  return list.size() == 1 && std::string(element.name()) != "data" ? list[0] : list;
}

/// A matrix of XML, or other words, as it is in YAML.
YAML::Node nodeOf(const pugi::xml_node& element) {
  if (!element.child("data")) return wordsOf(element);
  YAML::Node node;
  for (const char* key : {"rows", "cols", "dt", "data"}) node[key] = wordsOf(element.child(key));
  return node;
}

/// Everything at the top level of some cv::FileStorage files; of equal names, the first counts.
class StoredValues {
 public:
  explicit StoredValues(const std::vector<fs::path>& files) {
    for (const auto& file : files) {
      origin_ += (origin_.empty() ? "" : " + ") + file.string();
      const std::string text = readText(file);
      text.compare(0, 5, "<?xml") == 0 ? addXml(file, text) : addYaml(file, text);
    }
  }

  const std::string& origin() const { return origin_; }

  /// The first of `names` that is there, else an empty matrix.
  /// @param rows, cols  What it must have; 0: one row or one column of any length.
  cv::Mat find(std::initializer_list<const char*> names, int rows, int cols) const {
    for (const char* name : names) {
      const auto found = values_.find(name);
      if (found == values_.end()) continue;
      const StoredValue& value = found->second;
      const bool fits =
          rows > 0 ? value.rows == rows && value.cols == cols : value.rows == 1 || value.cols == 1;
      const double count = static_cast<double>(value.rows) * value.cols;
      if (!fits || value.numbers.empty() || count != static_cast<double>(value.numbers.size())) {
        fail(origin_, "the value of " + value.name + " has not the right shape");
      }
      return cv::Mat(value.numbers, true).reshape(1, value.rows);
    }
    return {};
  }

  cv::Mat get(std::initializer_list<const char*> names, int rows, int cols,
              const std::string& meaning) const {
    cv::Mat matrix = find(names, rows, cols);
    if (matrix.empty()) fail(origin_, meaning + " is missing");
    return matrix;
  }

  bool tellsSize() const { return !size({}).empty(); }

  cv::Size size(cv::Size fallback) const {
    const auto both = numbers({"imagesize", "imgsize", "size"}, 2);
    if (!both.empty()) return cv::Size2d(both[0], both[1]);
    const auto width = numbers({"imagewidth", "width"}, 1);
    const auto height = numbers({"imageheight", "height"}, 1);
    if (width.empty() || height.empty()) return fallback;
    const cv::Size size = cv::Size2d(width[0], height[0]);
    return size.empty() ? fallback : size;
  }

 private:
  void add(const std::string& name, const YAML::Node& node) {
    values_.emplace(plainName(name), storedValue(name, node));
  }

  void addYaml(const fs::path& file, const std::string& text) {
    for (const auto& entry : readYaml(file, text)) add(entry.first.Scalar(), entry.second);
  }

  void addXml(const fs::path& file, const std::string& text) {
    pugi::xml_document document;
    if (!document.load_buffer(text.data(), text.size())) fail(file.string(), "it is not XML");
    const auto values = document.child("opencv_storage").children();
    if (values.empty()) fail(file.string(), "it holds no named values");
    for (const pugi::xml_node& value : values) add(value.name(), nodeOf(value));
  }

  /// The first of `names` that is so many numbers, else nothing.
  std::vector<double> numbers(std::initializer_list<const char*> names, std::size_t count) const {
    for (const char* name : names) {
      const auto found = values_.find(name);
      if (found != values_.end() && found->second.numbers.size() == count) {
        return found->second.numbers;
      }
    }
    return {};
  }

  std::string origin_;
  std::map<std::string, StoredValue> values_;
};

RawCamera rectifiedAs(const cv::Mat& P) {
  return {P.colRange(0, 3).clone(), cv::Mat(), cv::Mat::eye(3, 3, CV_64F), P};
}

// --- ROS ----------------------------------------------------------------------------------------

/// The first of `names` that is there: a file of camera_calibration says `camera_matrix`, an echoed
/// message `K` (ROS 1) or `k` (ROS 2).
YAML::Node find(const YAML::Node& root, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (root[name]) return root[name];
  }
  return YAML::Node(YAML::NodeType::Undefined);
}

cv::Mat readMatrix(const fs::path& file, const YAML::Node& root,
                   std::initializer_list<const char*> names, int rows, int cols) {
  const char* name = *names.begin();
  YAML::Node node = find(root, names);
  if (!node) fail(file.string(), std::string(name) + " is missing");
  if (node.IsMap()) node.reset(node["data"]);
  std::vector<double> values;
  try {
    values = node.as<std::vector<double>>();
  } catch (const YAML::Exception&) {
    fail(file.string(), std::string(name) + " is not a list of numbers");
  }
  if (rows > 0 && values.size() != static_cast<std::size_t>(rows * cols)) {
    fail(file.string(),
         std::string(name) + " has not " + std::to_string(rows * cols) + " elements");
  }
  if (values.empty()) return {};
  return cv::Mat(values, true).reshape(1, rows > 0 ? rows : 1);
}

struct CameraInfo {
  RawCamera camera;
  cv::Size size;
};

CameraInfo readOne(const fs::path& file) {
  const YAML::Node root = readYaml(file, readText(file));
  CameraInfo info;
  const YAML::Node width = find(root, {"image_width", "width"});
  const YAML::Node height = find(root, {"image_height", "height"});
  if (!width || !height) fail(file.string(), "image_width or image_height is missing");
  try {
    info.size = {width.as<int>(), height.as<int>()};
  } catch (const YAML::Exception&) {
    fail(file.string(), "image_width or image_height is not a number");
  }
  const YAML::Node model = find(root, {"distortion_model"});
  const std::string name = model && model.IsScalar() ? model.Scalar() : "plumb_bob";
  info.camera.K = readMatrix(file, root, {"camera_matrix", "K", "k"}, 3, 3);
  setDistortion(file.string(), name,
                readMatrix(file, root, {"distortion_coefficients", "D", "d"}, 0, 0), info.camera);
  info.camera.R = readMatrix(file, root, {"rectification_matrix", "R", "r"}, 3, 3);
  info.camera.P = readMatrix(file, root, {"projection_matrix", "P", "p"}, 3, 4);
  return info;
}

/// The middle of a lens is near the middle of the images that it makes: of others, half or twice as
/// large, it is at a quarter of their length, or at their end.
void checkMiddle(const cv::Mat& K, cv::Size size, const std::string& origin) {
  const auto isNear = [](double middle, int length) {
    return middle > 0.3 * length && middle < 0.7 * length;
  };
  const double cx = K.at<double>(0, 2), cy = K.at<double>(1, 2);
  if (isNear(cx, size.width) && isNear(cy, size.height)) return;
  std::ostringstream why;
  why << "it tells no size, and is of others than these images of " << size.width << 'x'
      << size.height << ": the middle of its lens is at (" << cx << ", " << cy << ')';
  fail(origin, why.str());
}

}  // namespace

StereoRig readOpenCvCalibration(const std::vector<fs::path>& files, cv::Size image_size) {
  if (files.empty()) throw std::invalid_argument("readOpenCvCalibration: no file is named");
  const StoredValues stored(files);
  const cv::Size size = stored.size(image_size);
  RawCamera left, right;
  left.P = stored.find({"p1", "pl", "pleft", "projectionmatrixleft", "projectionmatrix1"}, 3, 4);
  right.P = stored.find({"p2", "pr", "pright", "projectionmatrixright", "projectionmatrix2"}, 3, 4);
  left.K = stored.find({"m1", "k1", "cameramatrix1", "cameramatrixleft", "leftcameramatrix",
                        "cameramatrixl", "kleft", "mleft", "kl", "ml", "leftk"},
                       3, 3);
  if (left.K.empty() && !left.P.empty() && !right.P.empty()) {
    return StereoRig(rectifiedAs(left.P), rectifiedAs(right.P), size, stored.origin());
  }
  if (left.K.empty()) fail(stored.origin(), "the pair's left camera matrix (M1) is missing");
  right.K = stored.get({"m2", "k2", "cameramatrix2", "cameramatrixright", "rightcameramatrix",
                        "cameramatrixr", "kright", "mright", "kr", "mr", "rightk"},
                       3, 3, "the right camera matrix (M2)");
  if (!stored.tellsSize() && !size.empty()) {
    for (const RawCamera* raw : {&left, &right}) checkMiddle(raw->K, size, stored.origin());
  }
  left.distortion =
      stored.get({"d1", "distcoeffs1", "distcoeff1", "distortioncoefficients1", "distortion1",
                  "distcoeffsleft", "leftdistcoeffs", "distortioncoefficientsleft",
                  "leftdistortioncoefficients", "distcoeffsl", "dleft", "dl", "leftd"},
                 0, 0, "the left distortion (D1)");
  right.distortion =
      stored.get({"d2", "distcoeffs2", "distcoeff2", "distortioncoefficients2", "distortion2",
                  "distcoeffsright", "rightdistcoeffs", "distortioncoefficientsright",
                  "rightdistortioncoefficients", "distcoeffsr", "dright", "dr", "rightd"},
                 0, 0, "the right distortion (D2)");
  left.R = stored.find({"r1", "rl", "rleft", "rectificationmatrixleft"}, 3, 3);
  right.R = stored.find({"r2", "rr", "rright", "rectificationmatrixright"}, 3, 3);
  if (left.R.empty() || right.R.empty() || left.P.empty() || right.P.empty()) {
    const cv::Mat R = stored.get({"r", "rotation", "rotationmatrix"}, 3, 3, "the rotation (R)");
    const cv::Mat T =
        stored.get({"t", "translation", "translationvector"}, 0, 0, "the translation (T)");
    if (T.total() != 3) fail(stored.origin(), "the translation (T) has not three elements");
    if (cv::norm(T) < 1e-9) fail(stored.origin(), "there is no baseline between the cameras");
    if (size.empty()) fail(stored.origin(), "the size of the images is not given");
    for (const RawCamera* raw : {&left, &right}) {
      checkDistortion(stored.origin(), *raw);
    }
    cv::Mat Q;
    cv::stereoRectify(left.K, left.distortion, right.K, right.distortion, size, R, T.reshape(1, 3),
                      left.R, right.R, left.P, right.P, Q, cv::CALIB_ZERO_DISPARITY, 0.0);
  }
  return StereoRig(left, right, size, stored.origin());
}

StereoRig readCameraInfo(const fs::path& left, const fs::path& right) {
  const CameraInfo l = readOne(left), r = readOne(right);
  if (l.size != r.size) fail(right.string(), "its image size is not that of " + left.string());
  return StereoRig(l.camera, r.camera, l.size, right.string());
}

}  // namespace heel
