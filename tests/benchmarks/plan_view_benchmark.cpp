// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Plan view and world blobs against PCL's voxel grid and Euclidean clusters, on the same points,
/// one thread each; and a whole frame of phase 1.

#include <heel/segmentation/background_model.hpp>
#include <heel/segmentation/height_crop.hpp>
#include <heel/segmentation/plan_view.hpp>
#include <heel/segmentation/world_blobs.hpp>

#include <benchmark/benchmark.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>

#include <cmath>
#include <random>

namespace {

using heel::ColorCloud;

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr double kFocal_px = 525.0;
constexpr double kCamera_m = 1.0;  // height over the floor

// A camera that looks ahead: base x is its z, y its -x, z its -y.
Eigen::Isometry3d mounting() {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  T.translation().z() = kCamera_m;
  return T;
}

const heel::PinholeCamera kCamera{kWidth, kHeight, kFocal_px, kFocal_px, 319.5, 239.5};

// Somebody seen from the front: a cylinder, 0.4 m wide and 1.75 m high.
struct Body {
  double x, y;
};

// A wall at 6 m and the bodies before it, with a depth sensor's noise that grows with its square.
struct Scene {
  cv::Mat depth{kHeight, kWidth, CV_32FC1, cv::Scalar::all(6.0)};
  cv::Mat image{kHeight, kWidth, CV_8UC3, cv::Scalar::all(150)};
  cv::Mat bodies{kHeight, kWidth, CV_8UC1, cv::Scalar::all(0)};

  explicit Scene(std::initializer_list<Body> people) {
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0.0, 1.0);
    for (int v = 0; v < kHeight; ++v) {
      for (int u = 0; u < kWidth; ++u) {
        const double side = (kCamera.cx - u) / kFocal_px;
        const double up = (kCamera.cy - v) / kFocal_px;
        double nearest = 6.0;
        for (const Body& body : people) {
          const double off = side * body.x - body.y;
          const double z = kCamera_m + up * body.x;
          if (std::abs(off) >= 0.2 || z < 0.0 || z > 1.75) continue;
          nearest = std::min(nearest, body.x - std::sqrt(0.04 - off * off));
        }
        if (nearest < 6.0) {
          bodies.at<std::uint8_t>(v, u) = 255;
          image.at<cv::Vec3b>(v, u) = {60, 40, 30};
        }
        depth.at<float>(v, u) =
            static_cast<float>(nearest + 0.0015 * nearest * nearest * noise(random));
      }
    }
  }
};

const Scene& peopled() {
  static const Scene scene({{2.6, -0.9}, {3.8, 0.9}});
  return scene;
}

// The scene's candidates: the standing points of the bodies.
struct Candidates {
  ColorCloud::Ptr cloud{new ColorCloud};
  pcl::IndicesPtr indices{new pcl::Indices};

  Candidates() {
    heel::makeColorCloud(peopled().depth, peopled().image, peopled().bodies, kCamera, mounting(),
                         *cloud, *indices);
    heel::HeightCrop().apply(cloud, indices, *indices);
  }
};

void planViewAndBlobs(benchmark::State& state) {
  const Candidates candidates;
  heel::PlanView view({}, {{0.0, 0.0, kCamera_m}, kFocal_px});
  heel::WorldBlobFinder finder;
  std::vector<heel::WorldBlob> blobs;
  for (auto _ : state) {
    view.build(*candidates.cloud, *candidates.indices);
    finder.find(view, blobs);
    benchmark::DoNotOptimize(blobs.data());
  }
  state.counters["points"] = static_cast<double>(candidates.indices->size());
  state.counters["found"] = static_cast<double>(blobs.size());
}
BENCHMARK(planViewAndBlobs)->Unit(benchmark::kMicrosecond);

// The same cell size, and a distance that joins neighbours as we do.
void voxelGridAndClusters(benchmark::State& state) {
  const Candidates candidates;
  pcl::VoxelGrid<pcl::PointXYZRGB> grid;
  grid.setLeafSize(0.05F, 0.05F, 0.05F);
  pcl::EuclideanClusterExtraction<pcl::PointXYZRGB> extraction;
  extraction.setClusterTolerance(0.1);
  extraction.setMinClusterSize(10);
  std::vector<pcl::PointIndices> clusters;
  for (auto _ : state) {
    const ColorCloud::Ptr thinned(new ColorCloud);
    grid.setInputCloud(candidates.cloud);
    grid.setIndices(candidates.indices);
    grid.filter(*thinned);
    const pcl::search::KdTree<pcl::PointXYZRGB>::Ptr tree(
        new pcl::search::KdTree<pcl::PointXYZRGB>);
    tree->setInputCloud(thinned);
    extraction.setSearchMethod(tree);
    extraction.setInputCloud(thinned);
    clusters.clear();
    extraction.extract(clusters);
    benchmark::DoNotOptimize(clusters.data());
  }
  state.counters["points"] = static_cast<double>(candidates.indices->size());
  state.counters["found"] = static_cast<double>(clusters.size());
}
BENCHMARK(voxelGridAndClusters)->Unit(benchmark::kMicrosecond);

// Background, cloud, height crop, plan view, blobs.
void phase1Frame(benchmark::State& state) {
  heel::BackgroundLearner learner;
  const Scene empty({});
  learner.add(empty.image, empty.depth);
  const heel::BackgroundModel background = learner.model();
  heel::Foreground foreground;
  const ColorCloud::Ptr cloud(new ColorCloud);
  const pcl::IndicesPtr indices(new pcl::Indices);
  pcl::Indices standing;
  heel::HeightCrop crop;
  heel::PlanView view({}, {{0.0, 0.0, kCamera_m}, kFocal_px});
  heel::WorldBlobFinder finder;
  std::vector<heel::WorldBlob> blobs;
  for (auto _ : state) {
    background.extract(peopled().image, peopled().depth, foreground);
    heel::makeColorCloud(peopled().depth, peopled().image, foreground.mask, kCamera, mounting(),
                         *cloud, *indices);
    crop.apply(cloud, indices, standing);
    view.build(*cloud, standing);
    finder.find(view, blobs);
    benchmark::DoNotOptimize(blobs.data());
  }
  state.counters["points"] = static_cast<double>(standing.size());
  state.counters["found"] = static_cast<double>(blobs.size());
}
BENCHMARK(phase1Frame)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
