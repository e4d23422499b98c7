// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cloud/stereo_calibration.hpp"

#include <opencv2/calib3d.hpp>

#include <algorithm>
#include <cctype>
#include <exception>
#include <fstream>
#include <initializer_list>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace heel {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& origin, const std::string& reason) {
  throw std::runtime_error(origin + ": " + reason);
}

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

/// OpenCV's parser goes into itself at each bracket, tag or list within another, with no end.
bool isTooDeep(const fs::path& file) {
  constexpr int kMost = 100;
  std::ifstream in(file, std::ios::binary);
  int depth = 0;
  for (std::string line; std::getline(in, line);) {
    // A list in YAML may also be deeper with each blank or dash before it.
    if (std::min(line.find_first_not_of(" -"), line.size()) > kMost) return true;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const char c = line[i], next = i + 1 < line.size() ? line[i + 1] : ' ';
      if (c == '[' || c == '{' || (c == '<' && next != '/' && next != '?' && next != '!')) ++depth;
      if (c == ']' || c == '}' || (c == '<' && next == '/') || (c == '/' && next == '>')) --depth;
      if (depth > kMost) return true;
    }
  }
  return false;
}

/// Everything at the top level of some cv::FileStorage files; of equal names, the first counts.
class StoredValues {
 public:
  explicit StoredValues(const std::vector<fs::path>& files) {
    for (const auto& file : files) {
      origin_ += (origin_.empty() ? "" : " + ") + file.string();
      if (!fs::is_regular_file(file)) fail(file.string(), "there is no such file");
      if (isTooDeep(file)) fail(file.string(), "its values are too deep within each other");
      bool has_names = false;
      try {
        storages_.emplace_back(file.string(), cv::FileStorage::READ);
        const cv::FileNode root = storages_.back().root();
        has_names = root.isMap();
        for (const auto& name : has_names ? root.keys() : std::vector<std::string>()) {
          nodes_.emplace(plainName(name), root[name]);
        }
      } catch (const std::exception&) {  // OpenCV's parser throws length_error, too
        fail(file.string(), "it is not an OpenCV calibration file (YAML, XML or JSON)");
      }
      if (!has_names) fail(file.string(), "it holds no named values");
    }
  }

  const std::string& origin() const { return origin_; }

  static constexpr double kMostOfASide = 100.0;

  /// The first of `names` that is there, else an empty matrix.
  cv::Mat find(std::initializer_list<const char*> names, int rows, int cols) const {
    for (const char* name : names) {
      const auto node = nodes_.find(name);
      if (node == nodes_.end()) continue;
      cv::Mat stored, matrix;
      // A matrix is as large as it says, whatever it holds; a text counts as 2^31 - 1.
      const auto isSmall = [&](const char* key) {
        const cv::FileNode side = node->second.isMap() ? node->second[key] : cv::FileNode();
        if (!side.isInt() && !side.isReal()) return false;
        return static_cast<double>(side) >= 0.0 && static_cast<double>(side) <= kMostOfASide;
      };
      try {
        if (isSmall("rows") && isSmall("cols")) node->second >> stored;
        stored.convertTo(matrix, CV_64F);
      } catch (const std::exception&) {
        matrix.release();
      }
      const bool fits = rows > 0 ? matrix.rows == rows && matrix.cols == cols
                                 : matrix.rows == 1 || matrix.cols == 1;
      if (matrix.empty() || !fits) {
        fail(origin_,
             std::string("the value of ") + node->second.name() + " has not the right shape");
      }
      return matrix;
    }
    return {};
  }

  cv::Mat get(std::initializer_list<const char*> names, int rows, int cols,
              const std::string& meaning) const {
    cv::Mat matrix = find(names, rows, cols);
    if (matrix.empty()) fail(origin_, meaning + " is missing");
    return matrix;
  }

  cv::Size size(cv::Size fallback) const {
    for (const char* name : {"imagesize", "imgsize", "size"}) {
      const auto node = nodes_.find(name);
      if (node != nodes_.end() && node->second.isSeq() && node->second.size() == 2) {
        return {static_cast<int>(node->second[0]), static_cast<int>(node->second[1])};
      }
    }
    const int width = number({"imagewidth", "width"}), height = number({"imageheight", "height"});
    return width > 0 && height > 0 ? cv::Size(width, height) : fallback;
  }

 private:
  int number(std::initializer_list<const char*> names) const {
    for (const char* name : names) {
      const auto node = nodes_.find(name);
      if (node != nodes_.end() && (node->second.isInt() || node->second.isReal())) {
        return static_cast<int>(node->second);
      }
    }
    return 0;
  }

  std::string origin_;
  std::vector<cv::FileStorage> storages_;
  std::map<std::string, cv::FileNode> nodes_;
};

RawCamera rectifiedAs(const cv::Mat& P) {
  return {P.colRange(0, 3).clone(), cv::Mat(), cv::Mat::eye(3, 3, CV_64F), P};
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
  if (left.K.empty()) fail(stored.origin(), "the left camera matrix (M1) is missing");
  right.K = stored.get({"m2", "k2", "cameramatrix2", "cameramatrixright", "rightcameramatrix",
                        "cameramatrixr", "kright", "mright", "kr", "mr", "rightk"},
                       3, 3, "the right camera matrix (M2)");
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
      checkDistortion(stored.origin(), raw->distortion.total());
    }
    cv::Mat Q;
    cv::stereoRectify(left.K, left.distortion, right.K, right.distortion, size, R, T.reshape(1, 3),
                      left.R, right.R, left.P, right.P, Q, cv::CALIB_ZERO_DISPARITY, 0.0);
  }
  return StereoRig(left, right, size, stored.origin());
}

}  // namespace heel
