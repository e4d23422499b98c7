// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/mapping/distance_transform.hpp>
#include <heel/mapping/likelihood_field.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace heel {
namespace {

constexpr double kSqrtTwoPi = 2.5066282746310002;

bool isSurface(const OccupancyGrid& map, const GridCell& cell) {
  if (map.at(cell) != Occupancy::kOccupied) return false;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const GridCell beside{cell.x + dx, cell.y + dy};
      if (!map.contains(beside) || map.at(beside) != Occupancy::kOccupied) return true;
    }
  }
  return false;
}

}  // namespace

LikelihoodField::LikelihoodField(const OccupancyGrid& map, const LikelihoodFieldParams& params)
    : params_(params),
      corner_m_(map.origin_m().array() - map.cell_size_m()),
      cell_size_m_(map.cell_size_m()),
      width_(map.width() + 2),
      height_(map.height() + 2) {
  if (map.empty()) throw std::invalid_argument("LikelihoodField: the map has no cells");
  if (!(params.hit_m > 0.0) || !(params.random_over_m > 0.0) || !(params.far_m > 0.0)) {
    throw std::invalid_argument("LikelihoodField: lengths must be positive");
  }
  if (!(params.hit_share > 0.0) || !(params.hit_share < 1.0)) {
    throw std::invalid_argument("LikelihoodField: hit_share must be between 0 and 1");
  }
  std::vector<std::uint8_t> surface(map.cells().size());
  for (GridCell c; c.y < map.height(); ++c.y) {
    for (c.x = 0; c.x < map.width(); ++c.x) surface[map.index(c)] = isSurface(map, c) ? 1 : 0;
  }
  std::vector<float> cells;
  DistanceTransform().compute(surface, map.width(), map.height(), 1.0, cells);
  const auto size = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  distance_m_.assign(size, static_cast<float>(params.far_m));
  log_likelihood_.assign(size, static_cast<float>(logLikelihoodAt(params.far_m)));
  for (GridCell c; c.y < map.height(); ++c.y) {
    for (c.x = 0; c.x < map.width(); ++c.x) {
      const double to_rim_m = (cells[map.index(c)] - 0.5) * cell_size_m_;
      const double d = std::clamp(to_rim_m, 0.0, params.far_m);
      const std::size_t i = static_cast<std::size_t>(c.y + 1) * static_cast<std::size_t>(width_) +
                            static_cast<std::size_t>(c.x + 1);
      const bool inside = map.at(c) == Occupancy::kOccupied;
      distance_m_[i] = inside ? std::min(-1e-6F, static_cast<float>(-d)) : static_cast<float>(d);
      log_likelihood_[i] = static_cast<float>(logLikelihoodAt(d));
    }
  }
}

double LikelihoodField::logLikelihoodAt(double distance_m) const {
  const double d = distance_m / params_.hit_m;
  return std::log(params_.hit_share * std::exp(-0.5 * d * d) / (params_.hit_m * kSqrtTwoPi) +
                  (1.0 - params_.hit_share) / params_.random_over_m);
}

// 0 goes first in std::max(), here and below: what is no number becomes 0, not an index.
std::size_t LikelihoodField::cellOf(double x_m, double y_m) const {
  const double u = std::min(std::max(0.0, (x_m - corner_m_.x()) / cell_size_m_), width_ - 0.5);
  const double v = std::min(std::max(0.0, (y_m - corner_m_.y()) / cell_size_m_), height_ - 0.5);
  return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) +
         static_cast<std::size_t>(u);
}

double LikelihoodField::distance_m(const Eigen::Vector2d& point) const {
  return std::abs(static_cast<double>(distance_m_[cellOf(point.x(), point.y())]));
}

double LikelihoodField::logLikelihood(const Eigen::Vector2d& end) const {
  return static_cast<double>(log_likelihood_[cellOf(end.x(), end.y())]);
}

void LikelihoodField::score(const BeamEnds& ends, std::size_t count, const float* x_m,
                            const float* y_m, const float* cosine, const float* sine,
                            float* sums) const {
  constexpr std::size_t kBlock = 64;
  std::array<int, kBlock> cells;
  const auto per_m = static_cast<float>(1.0 / cell_size_m_);
  const auto corner_x = static_cast<float>(corner_m_.x());
  const auto corner_y = static_cast<float>(corner_m_.y());
  const float last_u = static_cast<float>(width_) - 0.5F;
  const float last_v = static_cast<float>(height_) - 0.5F;
  const int width = width_;
  const float* field = log_likelihood_.data();
  for (std::size_t i = 0; i < count; ++i) {
    const float u0 = (x_m[i] - corner_x) * per_m, v0 = (y_m[i] - corner_y) * per_m;
    const float c = cosine[i] * per_m, s = sine[i] * per_m;
    float sum = 0.0F;
    for (std::size_t begin = 0; begin < ends.size(); begin += kBlock) {
      const std::size_t block = std::min(kBlock, ends.size() - begin);
      const float* ex = ends.x.data() + begin;
      const float* ey = ends.y.data() + begin;
      // Two loops: the first has no look-ups, so that the compiler makes vectors of it.
      for (std::size_t k = 0; k < block; ++k) {
        const float u = std::min(std::max(0.0F, u0 + c * ex[k] - s * ey[k]), last_u);
        const float v = std::min(std::max(0.0F, v0 + s * ex[k] + c * ey[k]), last_v);
        cells[k] = static_cast<int>(v) * width + static_cast<int>(u);
      }
      std::array<float, 4> part{};
      std::size_t k = 0;
      for (; k + 4 <= block; k += 4) {
        for (std::size_t j = 0; j < 4; ++j) part[j] += field[cells[k + j]];
      }
      for (; k < block; ++k) part[0] += field[cells[k]];
      sum += (part[0] + part[1]) + (part[2] + part[3]);
    }
    sums[i] = sum;
  }
}

double LikelihoodField::castRay(const Eigen::Vector2d& origin, double angle_rad,
                                double max_m) const {
  const Eigen::Vector2d along(std::cos(angle_rad), std::sin(angle_rad));
  // Nothing is nearer than the distance at a cell's middle, less the way from there.
  const double shortest_m = 0.5 * cell_size_m_, off_middle_m = 0.7072 * cell_size_m_;
  for (double range_m = 0.0; range_m < max_m;) {
    const Eigen::Vector2d p = origin + range_m * along;
    const float d = distance_m_[cellOf(p.x(), p.y())];
    if (d < 0.0F) return range_m;
    range_m += std::max(static_cast<double>(d) - off_middle_m, shortest_m);
  }
  return max_m;
}

}  // namespace heel
