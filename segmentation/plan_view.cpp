// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "segmentation/plan_view.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace heel {
namespace {

constexpr float kHighest_m = 1000.0F;  // leaves out what is not finite

int gridWidth(const PlanViewParams& params) {
  const bool positive = params.cell_size_m > 0.0 && params.max_range_m > 0.0;
  const double width = std::ceil(2.0 * params.max_range_m / params.cell_size_m) + 2.0;
  if (!positive || !(width <= 4096.0)) {
    throw std::invalid_argument(
        "plan view: cell size and range must be positive, and the grid "
        "not more than 4096 cells wide");
  }
  return static_cast<int>(width);
}

}  // namespace

PlanView::PlanView(const PlanViewParams& params, const PlanViewCamera& camera)
    : cell_size_m_(params.cell_size_m),
      cells_per_m_(static_cast<float>(1.0 / params.cell_size_m)),
      origin_m_(static_cast<float>(-params.max_range_m - params.cell_size_m)),
      limit_(static_cast<float>(gridWidth(params) - 1)),
      width_(gridWidth(params)),
      camera_m_(camera.position_m.cast<float>()),
      area_per_square_m_(
          static_cast<float>(1.0 / (camera.focal_length_px * camera.focal_length_px))),
      cells_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(width_)) {
  if (!camera.position_m.allFinite() || !(camera.focal_length_px > 0.0) ||
      !std::isfinite(camera.focal_length_px)) {
    throw std::invalid_argument("plan view: the camera must be finite, its focal length > 0");
  }
  occupied_.reserve(cells_.size() / 8);
}

void PlanView::build(const ColorCloud& cloud, const pcl::Indices& indices,
                     const ColorTable* colors) {
  for (const int cell : occupied_) cells_[static_cast<std::size_t>(cell)] = PlanCell{};
  occupied_.clear();
  points_ = 0;
  for (const pcl::index_t i : indices) {
    const pcl::PointXYZRGB& p = cloud[static_cast<std::size_t>(i)];
    const int at = cellAt(p.x, p.y);
    if (at < 0 || !(p.z >= 0.0F && p.z <= kHighest_m)) continue;
    PlanCell& cell = cells_[static_cast<std::size_t>(at)];
    if (cell.points++ == 0) occupied_.push_back(at);
    cell.max_height_m = std::max(cell.max_height_m, p.z);
    const float dx = p.x - camera_m_.x();
    const float dy = p.y - camera_m_.y();
    const float dz = p.z - camera_m_.z();
    cell.area_m2 += (dx * dx + dy * dy + dz * dz) * area_per_square_m_;
    if (colors != nullptr) {
      cell.appearance += static_cast<float>((*colors)(p.b, p.g, p.r)) * (1.0F / 255.0F);
    }
    ++points_;
  }
}

}  // namespace heel
