// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/clearance_map.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace heel {
namespace {

constexpr std::uint8_t kInMap = 1, kInLayer = 2, kInNextLayer = 4;

/// Squared distance, in cells, from the middle of a cell to a square that is `steps` away.
float squaredGap(int steps) {
  const float gap = std::max(0.0F, static_cast<float>(steps) - 0.5F);
  return gap * gap;
}

double squared(double x) { return x * x; }

/// One side, to the greater x, of what a disc sweeps.
class SweptSide {
 public:
  SweptSide(Eigen::Vector2d a, Eigen::Vector2d b, double radius) : radius_(radius) {
    if (a.y() > b.y()) std::swap(a, b);
    low_ = a;
    high_ = b;
    peak_y_ = a.x() > b.x() ? a.y() : b.y();
    const double rise = b.y() - a.y(), length = (b - a).norm();
    if (rise <= 0.0) {  // Level: no straight part on this side.
      if (a.x() < b.x()) low_ = b;
      line_low_y_ = line_high_y_ = a.y();
      line_x_ = low_.x() + radius;
      high_ = low_;
      return;
    }
    const Eigen::Vector2d outward(rise / length, -(b.x() - a.x()) / length);
    line_low_y_ = a.y() + radius * outward.y();
    line_high_y_ = b.y() + radius * outward.y();
    line_x_ = a.x() + radius * outward.x();
    slope_ = (b.x() - a.x()) / rise;
  }

  /// The greatest x that the disc comes to within these y.
  double greatest(double y0, double y1) const {
    const double y = std::clamp(peak_y_, y0, y1);
    if (y < line_low_y_) return onDisc(low_, y);
    if (y > line_high_y_) return onDisc(high_, y);
    return line_x_ + slope_ * (y - line_low_y_);
  }

 private:
  double onDisc(const Eigen::Vector2d& c, double y) const {
    return c.x() + std::sqrt(std::max(0.0, radius_ * radius_ - squared(y - c.y())));
  }

  double radius_;
  Eigen::Vector2d low_, high_;
  double peak_y_, line_low_y_, line_high_y_, line_x_, slope_ = 0.0;
};

}  // namespace

ClearanceMap::ClearanceMap(const OccupancyGrid& map, double reach_m, bool unknown_is_free)
    : origin_m_(map.origin_m()),
      cell_size_m_(map.cell_size_m()),
      width_(map.width()),
      height_(map.height()) {
  if (map.empty()) throw std::invalid_argument("a map to plan on must have cells");
  if (!(reach_m > 0.0) || !std::isfinite(reach_m)) {
    throw std::invalid_argument("the reach of clearances must be positive");
  }
  reach_ = reach_m / cell_size_m_;
  const std::size_t size = map.cells().size();
  blocked_.resize(size);
  next_blocked_.resize(size);
  clearance_.resize(size);
  column_.resize(size);
  steps_.resize(static_cast<std::size_t>(width_));
  row_.resize(static_cast<std::size_t>(width_));
  for (std::size_t i = 0; i < size; ++i) {
    const Occupancy cell = map.cells()[i];
    const bool free = cell == Occupancy::kFree || (unknown_is_free && cell == Occupancy::kUnknown);
    blocked_[i] = free ? 0 : kInMap;
  }
  for (int y = 0; y < height_; ++y) findNextBlocked(y);
  measure(0, 0, width_ - 1, height_ - 1);
}

bool ClearanceMap::isInside(const Eigen::Vector2d& point) const {
  const Eigen::Vector2d p = (point - origin_m_) / cell_size_m_;
  return p.x() >= 0.0 && p.y() >= 0.0 && p.x() < width_ && p.y() < height_;
}

int ClearanceMap::cellOf(const Eigen::Vector2d& point) const {
  const Eigen::Vector2d p = (point - origin_m_) / cell_size_m_;
  return static_cast<int>(p.y()) * width_ + static_cast<int>(p.x());
}

void ClearanceMap::addToLayer(int x0, int y0, int x1, int y1, const FloorDisc* disc) {
  x0 = std::max(x0, 0);
  y0 = std::max(y0, 0);
  x1 = std::min(x1, width_ - 1);
  y1 = std::min(y1, height_ - 1);
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      if (disc != nullptr) {
        const Eigen::Vector2d c = (disc->center - origin_m_) / cell_size_m_;
        const double dx = c.x() - std::clamp(c.x(), double(x), x + 1.0);
        const double dy = c.y() - std::clamp(c.y(), double(y), y + 1.0);
        if (dx * dx + dy * dy >= squared(disc->radius_m / cell_size_m_)) continue;
      }
      std::uint8_t& cell = blocked_[index(y * width_ + x)];
      if ((cell & kInNextLayer) != 0) continue;
      cell |= kInNextLayer;
      next_layer_.push_back(y * width_ + x);
    }
  }
}

const std::vector<int>& ClearanceMap::setLayer(const std::vector<FloorDisc>& discs,
                                               const OccupancyGrid* cells) {
  next_layer_.clear();
  changed_.clear();
  const auto cell = [](double v) { return static_cast<int>(std::clamp(std::floor(v), -1e9, 1e9)); };
  for (const FloorDisc& disc : discs) {
    if (!disc.center.allFinite() || !std::isfinite(disc.radius_m)) {
      throw std::invalid_argument("a blocked disc must be finite");
    }
  }
  for (const FloorDisc& disc : discs) {
    const Eigen::Vector2d c = (disc.center - origin_m_) / cell_size_m_;
    const double r = disc.radius_m / cell_size_m_;
    addToLayer(cell(c.x() - r), cell(c.y() - r), cell(c.x() + r), cell(c.y() + r), &disc);
  }
  if (cells != nullptr) {
    constexpr double kHair = 1e-6;  // Of a cell: grids that fall together cover each other's once.
    const double scale = cells->cell_size_m() / cell_size_m_;
    const Eigen::Vector2d corner = (cells->origin_m() - origin_m_) / cell_size_m_;
    for (int y = 0; y < cells->height(); ++y) {
      for (int x = 0; x < cells->width(); ++x) {
        if (cells->at(GridCell{x, y}) != Occupancy::kOccupied) continue;
        const Eigen::Vector2d low = corner + scale * Eigen::Vector2d(x, y);
        addToLayer(cell(low.x() + kHair), cell(low.y() + kHair), cell(low.x() + scale - kHair),
                   cell(low.y() + scale - kHair), nullptr);
      }
    }
  }

  int x0 = width_, y0 = height_, x1 = -1, y1 = -1;
  const auto noteChange = [&](int i, std::uint8_t other_layer) {
    if ((blocked_[index(i)] & (kInMap | other_layer)) != 0) return;
    x0 = std::min(x0, i % width_);
    x1 = std::max(x1, i % width_);
    y0 = std::min(y0, i / width_);
    y1 = std::max(y1, i / width_);
  };
  for (const int i : layer_) noteChange(i, kInNextLayer);
  for (const int i : next_layer_) noteChange(i, kInLayer);
  for (const int i : layer_) blocked_[index(i)] &= kInMap | kInNextLayer;
  for (const int i : next_layer_) {
    blocked_[index(i)] = static_cast<std::uint8_t>((blocked_[index(i)] & kInMap) | kInLayer);
  }
  std::swap(layer_, next_layer_);
  if (x1 < 0) return changed_;
  for (int y = y0; y <= y1; ++y) findNextBlocked(y);
  const int reach = static_cast<int>(std::ceil(reach_)) + 1;
  measure(std::max(0, x0 - reach), std::max(0, y0 - reach), std::min(width_ - 1, x1 + reach),
          std::min(height_ - 1, y1 + reach));
  return changed_;
}

void ClearanceMap::findNextBlocked(int row) {
  int next = width_;
  for (int x = width_ - 1; x >= 0; --x) {
    if (isBlocked(row * width_ + x)) next = x;
    next_blocked_[index(row * width_ + x)] = next;
  }
}

/// First along columns, then along rows, where every cell takes the least over its neighbours
/// within reach; a distance to squares has no simple lower envelope, and the reach is short.
void ClearanceMap::measure(int x0, int y0, int x1, int y1) {
  const int reach = static_cast<int>(std::ceil(reach_)) + 1;
  const int from_x = std::max(0, x0 - reach), to_x = std::min(width_ - 1, x1 + reach);
  const int from_y = std::max(0, y0 - reach), to_y = std::min(height_ - 1, y1 + reach);
  const auto reached = static_cast<float>(reach_ * reach_);
  for (const bool up : {true, false}) {
    const bool from_border = up ? from_y == 0 : to_y == height_ - 1;
    std::fill(steps_.begin(), steps_.end(), from_border ? 0 : 2 * reach);
    for (int k = from_y; k <= to_y; ++k) {
      const int row = (up ? k : to_y + from_y - k) * width_;
      for (int x = from_x; x <= to_x; ++x) {
        int& steps = steps_[index(x)];
        steps = isBlocked(row + x) ? 0 : std::min(steps + 1, 2 * reach);
        float& gap = column_[index(row + x)];
        gap = up ? squaredGap(steps) : std::min(gap, squaredGap(steps));
      }
    }
  }
  using Row = Eigen::Map<Eigen::ArrayXf>;
  for (int y = y0; y <= y1; ++y) {
    float* const best = row_.data();
    std::fill(best + x0, best + x1 + 1, reached);
    for (int k = -reach; k <= reach; ++k) {
      const int low = std::max(x0, -k), high = std::min(x1, width_ - 1 - k);
      if (low > high) continue;
      Row out(best + low, high - low + 1);
      out = out.min(Row(&column_[index(y * width_ + low + k)], high - low + 1) +
                    squaredGap(std::abs(k)));
    }
    for (int x = x0; x <= x1; ++x) {
      const float to_border = squaredGap(std::min(x + 1, width_ - x));
      const float clearance = std::sqrt(std::min(best[x], to_border));
      float& old = clearance_[index(y * width_ + x)];
      if (old == clearance) continue;
      old = clearance;
      changed_.push_back(y * width_ + x);
    }
  }
}

double ClearanceMap::clearance(const Eigen::Vector2d& point) const {
  if (!isInside(point)) return 0.0;
  const Eigen::Vector2d p = (point - origin_m_) / cell_size_m_;
  double best = squared(std::min({reach_, p.x(), p.y(), width_ - p.x(), height_ - p.y()}));
  const auto isNearerIn = [&](int y) {  // whether anything can be, in this row
    const double dy = p.y() - std::clamp(p.y(), double(y), y + 1.0);
    if (dy * dy >= best) return false;
    const double half = std::sqrt(best - dy * dy);
    const int x1 = std::min(width_ - 1, static_cast<int>(p.x() + half));
    for (int x = std::max(0, static_cast<int>(p.x() - half)); x <= x1; ++x) {
      x = next_blocked_[index(y * width_ + x)];
      if (x > x1) break;
      const double dx = p.x() - std::clamp(p.x(), double(x), x + 1.0);
      best = std::min(best, dx * dx + dy * dy);
    }
    return true;
  };
  const int row = static_cast<int>(p.y());
  for (int y = row; y < height_ && isNearerIn(y); ++y) {
  }
  for (int y = row - 1; y >= 0 && isNearerIn(y); --y) {
  }
  return std::sqrt(best) * cell_size_m_;
}

bool ClearanceMap::isClear(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                           double radius_m) const {
  const Eigen::Vector2d a = (from - origin_m_) / cell_size_m_, b = (to - origin_m_) / cell_size_m_;
  const double radius = radius_m / cell_size_m_;
  const double low = std::min(a.y(), b.y()) - radius, high = std::max(a.y(), b.y()) + radius;
  if (!(low >= 0.0 && high <= height_)) return false;
  if (!(std::min(a.x(), b.x()) - radius >= 0.0 && std::max(a.x(), b.x()) + radius <= width_)) {
    return false;
  }
  // A short way in the open: clearance changes by no more than the way.
  constexpr double kHalfDiagonal = 0.708;
  const double room = clearanceInCells(cellOf(from)) + clearanceInCells(cellOf(to));
  if (room >= 2.0 * (radius + kHalfDiagonal) + (b - a).norm()) return true;
  const SweptSide right(a, b, radius);
  const SweptSide left({-a.x(), a.y()}, {-b.x(), b.y()}, radius);
  const int last_row = std::min(height_ - 1, static_cast<int>(std::ceil(high)) - 1);
  for (int y = static_cast<int>(low); y <= last_row; ++y) {
    const double x0 = std::max(0.0, -left.greatest(y, y + 1.0)), x1 = right.greatest(y, y + 1.0);
    if (next_blocked_[index(y * width_ + static_cast<int>(x0))] < x1) return false;
  }
  return true;
}

}  // namespace heel
