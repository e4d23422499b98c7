// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The scene from above: candidate points on a grid over the floor (section 3.2).
#pragma once

#include <heel/segmentation/color_table.hpp>

#include <Eigen/Core>
#include <pcl/point_cloud.h>
#include <pcl/types.h>

#include <cstddef>
#include <vector>

namespace heel {

/// How the floor is divided.
struct PlanViewParams {
  /// Edge of a cell. Coarser is faster, fits sparser clouds, and joins people who stand close.
  double cell_size_m = 0.05;
  /// The grid covers |x| and |y| up to this; points outside are left out.
  double max_range_m = 8.0;
};

/// From where the points were seen. A pixel at distance d stands for a surface of (d / f)^2, so
/// that a blob's area, unlike its points, does not depend on its range.
struct PlanViewCamera {
  Eigen::Vector3d position_m = {0.0, 0.0, 1.0};  ///< The camera, in the cloud's frame.
  double focal_length_px = 525.0;                ///< Of the image that the points come from.
};

/// What fell on one cell.
struct PlanCell {
  int points = 0;
  float max_height_m = 0.0F;  ///< The cell's weight in the paper.
  float area_m2 = 0.0F;       ///< Surface seen, facing the camera.
  float appearance = 0.0F;    ///< Sum of the points' colour scores, each in [0, 1].
};

/// Candidate points seen from above. Built anew for each frame in the same memory; the cost follows
/// the number of points, not the size of the grid.
class PlanView {
 public:
  /// @throws std::invalid_argument  if a size is not positive and finite, or the grid has more than
  ///                                2^24 cells.
  explicit PlanView(const PlanViewParams& params = {}, const PlanViewCamera& camera = {});

  /// Projects the points named by `indices` onto the floor; z is their height.
  ///
  /// Points without position, below the floor or off the grid are left out. `colors`, if not null,
  /// scores each point's colour.
  /// @tparam PointT  A PCL point with x, y, z, r, g, b. Instantiated for all of PCL's own; for
  ///                 another, `#define PCL_NO_PRECOMPILE` before including this.
  template <typename PointT>
  void build(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices,
             const ColorTable* colors = nullptr);

  double cellSize() const { return cell_size_m_; }
  int width() const { return width_; }  ///< Cells in a row (along y), and number of rows (along x).
  int points() const { return points_; }  ///< How many points lie on the grid.

  /// Cells that hold a point, in order of their first.
  const std::vector<int>& occupied() const { return occupied_; }

  const PlanCell& operator[](int cell) const { return cells_[static_cast<std::size_t>(cell)]; }

  /// The cell under (x, y), or -1 if off the grid or not a number. No cell of the outermost ring is
  /// ever used, so that the eight neighbours of a cell always exist.
  int cellAt(float x_m, float y_m) const {
    const float row = (x_m - origin_m_) * cells_per_m_;
    const float column = (y_m - origin_m_) * cells_per_m_;
    if (!(row >= 1.0F && row < limit_ && column >= 1.0F && column < limit_)) return -1;
    return static_cast<int>(row) * width_ + static_cast<int>(column);
  }

  /// Centre of a cell on the floor.
  Eigen::Vector2d center(int cell) const {
    const int row = cell / width_, column = cell % width_;
    return {static_cast<double>(origin_m_) + (row + 0.5) * cell_size_m_,
            static_cast<double>(origin_m_) + (column + 0.5) * cell_size_m_};
  }

 private:
  double cell_size_m_;
  float cells_per_m_;
  float origin_m_;  // x and y of the corner of cell 0
  float limit_;     // rows and columns from here on are off the grid
  int width_;
  Eigen::Vector3f camera_m_;
  float area_per_square_m_;  // 1 / f^2
  int points_ = 0;
  std::vector<PlanCell> cells_;
  std::vector<int> occupied_;
};

}  // namespace heel

#ifdef PCL_NO_PRECOMPILE  // users with a point type of their own get the body
#include <heel/segmentation/plan_view_impl.hpp>
#endif
