// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// pcl::VoxelGrid -> heel::AppearanceFilter -> pcl::StatisticalOutlierRemoval -> heel's plan view,
/// on a scene made so that what comes out of each is known exactly.
#pragma once

#include <heel/segmentation/appearance_filter.hpp>
#include <heel/segmentation/plan_view.hpp>
#include <heel/segmentation/world_blobs.hpp>

#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_cloud.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace consumer {

#define CHECK(holds)                                                           \
  do {                                                                         \
    if (!(holds)) {                                                            \
      std::fprintf(stderr, "%s:%d: not so: %s\n", __FILE__, __LINE__, #holds); \
      std::exit(1);                                                            \
    }                                                                          \
  } while (false)

constexpr float kVoxel_m = 0.1F;

/// Whoever wears red.
inline heel::ColorTable redTable() {
  return heel::ColorTable([](std::uint8_t, std::uint8_t, std::uint8_t r) { return r; });
}

/// Adds a box of points, eight to a voxel: `n` voxels along each axis from `corner` [voxels].
template <typename PointT>
void addBox(const int (&corner)[3], const int (&n)[3], std::uint8_t r, std::uint8_t b,
            pcl::PointCloud<PointT>& cloud) {
  const auto at = [](int first, int half) {
    return (static_cast<float>(2 * first + half) + 0.5F) * kVoxel_m / 2.0F;
  };
  for (int x = 0; x < 2 * n[0]; ++x) {
    for (int y = 0; y < 2 * n[1]; ++y) {
      for (int z = 0; z < 2 * n[2]; ++z) {
        PointT p;
        p.x = at(corner[0], x);
        p.y = at(corner[1], y);
        p.z = at(corner[2], z);
        p.r = r;
        p.g = 10;
        p.b = b;
        cloud.push_back(p);
      }
    }
  }
}

/// A red person of 2 x 4 x 12 voxels at (2.1, 0.2) m, three red specks, and a blue wall.
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr makeScene() {
  typename pcl::PointCloud<PointT>::Ptr cloud(new pcl::PointCloud<PointT>);
  addBox({20, 0, 5}, {2, 4, 12}, 200, 30, *cloud);
  addBox({10, 30, 10}, {1, 1, 1}, 200, 30, *cloud);
  addBox({50, -31, 5}, {1, 1, 1}, 200, 30, *cloud);
  addBox({-20, 0, 12}, {1, 1, 1}, 200, 30, *cloud);
  addBox({60, -10, 0}, {2, 20, 20}, 30, 200, *cloud);
  return cloud;
}

constexpr std::size_t kPerson = 2 * 4 * 12;
constexpr std::size_t kSpecks = 3;
constexpr std::size_t kWall = 2 * 20 * 20;

/// The scene, a point for each voxel.
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr makeVoxels() {
  pcl::VoxelGrid<PointT> voxel_grid;
  voxel_grid.setLeafSize(kVoxel_m, kVoxel_m, kVoxel_m);
  voxel_grid.setInputCloud(makeScene<PointT>());
  typename pcl::PointCloud<PointT>::Ptr voxels(new pcl::PointCloud<PointT>);
  voxel_grid.filter(*voxels);
  CHECK(voxels->size() == kPerson + kSpecks + kWall);
  return voxels;
}

template <typename PointT>
void runChain() {
  const auto voxels = makeVoxels<PointT>();

  heel::AppearanceFilter<PointT> by_color(true);
  by_color.setTable(redTable());
  by_color.setInputCloud(voxels);
  const pcl::IndicesPtr red(new pcl::Indices);
  by_color.filter(*red);
  CHECK(red->size() == kPerson + kSpecks);
  CHECK(by_color.getRemovedIndices()->size() == kWall);
  for (const auto i : *red) CHECK((*voxels)[i].r == 200 && (*voxels)[i].b == 30);

  pcl::StatisticalOutlierRemoval<PointT> no_specks;
  no_specks.setMeanK(8);
  no_specks.setStddevMulThresh(1.0);
  no_specks.setInputCloud(voxels);
  no_specks.setIndices(red);
  pcl::PointCloud<PointT> person;
  no_specks.filter(person);
  CHECK(person.size() == kPerson);

  heel::PlanViewParams params;
  params.cell_size_m = kVoxel_m;
  heel::PlanView view(params);
  pcl::Indices all(person.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<pcl::index_t>(i);
  const heel::ColorTable table = redTable();
  view.build(person, all, &table);
  CHECK(view.points() == static_cast<int>(kPerson));
  CHECK(view.occupied().size() == 2 * 4);
  for (const int cell : view.occupied()) {
    CHECK(view[cell].points == 12);
    CHECK(std::abs(view[cell].max_height_m - 1.65F) < 1e-4F);
  }

  heel::WorldBlobParams any_size;
  any_size.min_area_m2 = 0.0;
  std::vector<heel::WorldBlob> blobs;
  heel::WorldBlobFinder(any_size).find(view, blobs);
  CHECK(blobs.size() == 1);
  CHECK((blobs[0].position_m - Eigen::Vector2d(2.1, 0.2)).norm() < 0.01);
  CHECK(std::abs(blobs[0].appearance - 202.0 / 255.0) < 1e-4);  // the table's level of 200 is 202
}

/// On a point type of the consumer's own.
void runChainOnOwnPoint();

}  // namespace consumer
