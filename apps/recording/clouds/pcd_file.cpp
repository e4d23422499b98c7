// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/clouds/pcd_file.hpp>

#include <algorithm>

namespace heel {

void checkPcd(const std::filesystem::path& file) { needColors(file, checkPcdFile(file)); }

PcdFile readPcd(const std::filesystem::path& file) {
  checkPcd(file);
  return readCloud(file);
}

void colorsOf(const ColorCloud& cloud, cv::Mat& image_bgr) {
  image_bgr.create(static_cast<int>(cloud.height), static_cast<int>(cloud.width), CV_8UC3);
  std::transform(cloud.begin(), cloud.end(), image_bgr.begin<cv::Vec3b>(),
                 [](const auto& p) { return cv::Vec3b(p.b, p.g, p.r); });
}

void writePcd(const std::filesystem::path& file, const PcdFile& pcd) { writeCloud(file, pcd); }

}  // namespace heel
