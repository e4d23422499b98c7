// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/segmentation/plan_view.hpp>
#include <heel/segmentation/plan_view_impl.hpp>

#include <cmath>
#include <stdexcept>

namespace heel {
namespace {

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

}  // namespace heel

#ifndef PCL_NO_PRECOMPILE
#include <pcl/impl/instantiate.hpp>
#include <pcl/point_types.h>

PCL_INSTANTIATE(PlanView, PCL_RGB_POINT_TYPES)
#endif
