// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/depth_images.hpp>
#include <heel/apps/heel/commands.hpp>
#include <heel/apps/heel/inspect/inspect.hpp>
#include <heel/apps/heel/shared/cloud_summary.hpp>
#include <heel/apps/recording/clouds/cloud_file.hpp>
#include <heel/apps/recording/clouds/pcd_file.hpp>
#include <heel/cloud/color_cloud.hpp>
#include <heel/cloud/ground_plane.hpp>

#include <opencv2/imgproc.hpp>
#include <pcl/common/common.h>
#include <pcl/common/point_tests.h>

#include <cstdio>
#include <map>
#include <tuple>

namespace heel {

namespace fs = std::filesystem;

namespace {

void printBounds(const ColorCloud& cloud) {
  pcl::Indices finite;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (pcl::isFinite(cloud[i])) finite.push_back(static_cast<pcl::index_t>(i));
  }
  Eigen::Vector4f min, max;
  pcl::getMinMax3D(cloud, finite, min, max);
  std::printf("  x from %.2f to %.2f m, y from %.2f to %.2f m, z from %.2f to %.2f m\n",
              double{min.x()}, double{max.x()}, double{min.y()}, double{max.y()}, double{min.z()},
              double{max.z()});
}

/// How the camera stands, if the cloud is one camera's and sees the floor.
void printCamera(const ColorCloud& cloud) {
  if (const auto camera = fitPinhole(cloud)) {
    std::printf("  from one camera: fx %.1f fy %.1f cx %.1f cy %.1f\n", camera->fx, camera->fy,
                camera->cx, camera->cy);
  }
  GroundPlaneEstimator estimator;
  estimator.add(cloud);
  if (const auto floor = estimator.estimate()) {
    std::printf("  floor seen: camera %.2f m over it, pitch %.1f deg, roll %.1f deg\n",
                floor->mounting.height_m, floor->mounting.pitch_rad * kDegrees,
                floor->mounting.roll_rad * kDegrees);
  } else {
    std::printf("  no floor is seen (in a camera's frame, with y down)\n");
  }
}

/// What clouds of one kind have in common.
using Kind = std::tuple<std::string, std::string, bool, std::string, std::string>;

std::string toText(const Kind& kind) {
  const auto& [format, encoding, is_organized, color, fields] = kind;
  return format + " " + encoding + ", " + (is_organized ? "organized" : "not organized") + ", " +
         (color.empty() ? "no colour" : "colour in " + color) + ", fields " + fields;
}

}  // namespace

cv::Mat paintDepth(const cv::Mat& depth_m) {
  cv::Mat scaled, painted;
  depth_m.convertTo(scaled, CV_8UC1, -255.0 / 6.0, 255.0);
  cv::applyColorMap(scaled, painted, cv::COLORMAP_TURBO);
  painted.setTo(cv::Scalar::all(0), ~(depth_m > 0.0F));
  return painted;
}

cv::Mat inspectCloud(const fs::path& file) {
  const CloudFile cloud = readCloud(file);
  std::printf("%s: %s\n", file.filename().c_str(), toText(cloud.facts).c_str());
  printBounds(cloud.cloud);
  printCamera(cloud.cloud);
  if (!cloud.facts.isOrganized()) return {};
  cv::Mat depth_m;
  depthOf(cloud.cloud, depth_m);
  cv::Mat picture = paintDepth(depth_m);
  if (cloud.facts.color_field.empty()) return picture;
  cv::Mat colors;
  colorsOf(cloud.cloud, colors);
  cv::hconcat(colors, picture, picture);
  return picture;
}

void inspectClouds(const fs::path& what) {
  constexpr std::size_t kFew = 20;
  const auto clouds = findClouds({what.string()});
  std::map<Kind, std::size_t> kinds;
  std::string lines;
  const std::vector<std::string> failures = workOnClouds(
      "inspecting", clouds.size(), 0,
      [&](std::size_t i, CloudFate&) { return readCloud(clouds[i]).facts; },
      [&](std::size_t i, const CloudFate& fate, const CloudFacts& facts) {
        if (fate.hasFailed()) return;
        ++kinds[{facts.format, toText(facts.encoding), facts.isOrganized(), facts.color_field,
                 facts.fields}];
        lines += "  " + clouds[i].filename().string() + ": " + toText(facts) + "\n";
      });
  if (failures.size() < clouds.size()) {
    std::printf("%zu clouds:\n", clouds.size() - failures.size());
    for (const auto& [kind, count] : kinds) {
      std::printf("  %zu x %s\n", count, toText(kind).c_str());
    }
    if (clouds.size() <= kFew) std::printf("each:\n%s", lines.c_str());
  }
  tellFailures(failures, clouds.size());
}

}  // namespace heel
