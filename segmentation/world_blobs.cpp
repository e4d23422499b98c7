// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/segmentation/world_blobs.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace heel {
namespace {

constexpr double kMaxExtent_m = 1.2;  // What is longer than this along the floor is furniture.

// Labels of cells that belong to no blob.
constexpr int kNone = -1;     // empty, or in a component too small
constexpr int kPending = -2;  // occupied, not yet visited

constexpr double kLeastArea_m2 = 1e-12;  // points in the camera itself still have a place

constexpr int kPeakRadius = 2;  // a peak is the greatest of 5 x 5 cells

std::size_t at(int row, int column, int columns) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
         static_cast<std::size_t>(column);
}

}  // namespace

bool hasPersonShape(const WorldBlob& blob, const PersonShape& shape) {
  return blob.max_height_m >= shape.min_height_m && blob.max_height_m <= shape.max_height_m &&
         blob.area_m2 >= shape.min_area_m2 && blob.extent_m <= kMaxExtent_m;
}

WorldBlobFinder::WorldBlobFinder(const WorldBlobParams& params) : params_(params) {
  if (params.min_points < 1 || !(params.min_area_m2 >= 0.0)) {
    throw std::invalid_argument("world blobs: need min_points >= 1 and min_area_m2 >= 0");
  }
  if (!(params.max_gap_m >= 0.0 && params.max_gap_m <= 1.0) ||
      !(params.smoothing_m >= 0.0 && params.smoothing_m <= 1.0) ||
      !(params.min_separation_m >= 0.0) ||
      !(params.max_valley >= 0.0 && params.max_valley <= 1.0)) {
    throw std::invalid_argument(
        "world blobs: need max_gap_m, smoothing_m and max_valley in [0, 1] and min_separation_m >= "
        "0");
  }
}

void WorldBlobFinder::find(const PlanView& view, std::vector<WorldBlob>& blobs) {
  blobs.clear();
  const auto cells =
      static_cast<std::size_t>(view.width()) * static_cast<std::size_t>(view.width());
  if (labels_.size() != cells) {
    labels_.assign(cells, kNone);
  } else {
    for (const int cell : touched_) labels_[static_cast<std::size_t>(cell)] = kNone;
  }
  if (cell_size_m_ != view.cellSize()) {
    cell_size_m_ = view.cellSize();
    min_separation_cells_ = params_.min_separation_m / view.cellSize();
    reach_ = 1 + static_cast<int>(params_.max_gap_m / view.cellSize() + 1e-6);
    const double sigma = params_.smoothing_m / view.cellSize();
    kernel_.assign(static_cast<std::size_t>(std::ceil(2.0 * sigma)) + 1, 1.0F);
    for (std::size_t i = 1; i < kernel_.size(); ++i) {
      const double d = static_cast<double>(i) / sigma;
      kernel_[i] = static_cast<float>(std::exp(-0.5 * d * d));
    }
  }
  touched_ = view.occupied();
  for (const int cell : touched_) labels_[static_cast<std::size_t>(cell)] = kPending;
  for (const int seed : touched_) {
    if (labels_[static_cast<std::size_t>(seed)] != kPending) continue;
    const Box box = collect(view, seed);
    int points = 0;
    float area = 0.0F;
    for (const int cell : component_) {
      points += view[cell].points;
      area += view[cell].area_m2;
    }
    if (points < params_.min_points || static_cast<double>(area) < params_.min_area_m2) continue;
    peaks_.clear();
    if (params_.split) findPeaks(view, box);
    if (peaks_.empty()) peaks_.push_back({box.first_row, box.first_column, 0.0F});
    addParts(view, box, blobs);
  }
  sortByScore(blobs);
}

// Gathers the seed's component into component_, labels it kNone, and returns its box.
WorldBlobFinder::Box WorldBlobFinder::collect(const PlanView& view, int seed) {
  const int width = view.width();
  Box box{width, 0, width, 0};
  component_.clear();
  component_.push_back(seed);
  labels_[static_cast<std::size_t>(seed)] = kNone;
  for (std::size_t next = 0; next < component_.size(); ++next) {
    const int cell = component_[next];
    box.first_row = std::min(box.first_row, cell / width);
    box.last_row = std::max(box.last_row, cell / width);
    box.first_column = std::min(box.first_column, cell % width);
    box.last_column = std::max(box.last_column, cell % width);
    // Rows and columns that exist; the view's outermost ring is always empty.
    const int up = std::min(reach_, cell / width);
    const int down = std::min(reach_, width - 1 - cell / width);
    const int left = std::min(reach_, cell % width);
    const int right = std::min(reach_, width - 1 - cell % width);
    for (int row = -up; row <= down; ++row) {
      for (int column = -left; column <= right; ++column) {
        const int neighbour = cell + row * width + column;
        int& label = labels_[static_cast<std::size_t>(neighbour)];
        if (label != kPending) continue;
        label = kNone;
        component_.push_back(neighbour);
      }
    }
  }
  return box;
}

// Smooths the component's surface in its box and lists the peaks that stand apart, highest first.
void WorldBlobFinder::findPeaks(const PlanView& view, const Box& box) {
  const int radius = static_cast<int>(kernel_.size()) - 1;
  const int margin = std::max(radius, kPeakRadius);
  const int columns = box.last_column - box.first_column + 1 + 2 * margin;
  const int rows = box.last_row - box.first_row + 1 + 2 * margin;
  surface_.assign(at(rows, 0, columns), 0.0F);
  blurred_.assign(surface_.size(), 0.0F);
  const int width = view.width();
  const auto inBox = [&](int cell) {
    return at(cell / width - box.first_row + margin, cell % width - box.first_column + margin,
              columns);
  };
  for (const int cell : component_) surface_[inBox(cell)] = view[cell].area_m2;

  // Down the columns into blurred_, then along the rows back into surface_.
  const auto blur = [&](const std::vector<float>& in, std::vector<float>& out, std::size_t step) {
    const std::size_t reach = step * static_cast<std::size_t>(radius);
    const std::size_t end = in.size() - reach;
    for (std::size_t i = reach; i < end; ++i) out[i] = in[i];
    for (std::size_t k = 1; k < kernel_.size(); ++k) {
      const float weight = kernel_[k];
      const float* before = in.data() - k * step;
      const float* after = in.data() + k * step;
      for (std::size_t i = reach; i < end; ++i) out[i] += weight * (before[i] + after[i]);
    }
  };
  blur(surface_, blurred_, static_cast<std::size_t>(columns));
  blur(blurred_, surface_, 1);

  candidates_.clear();
  for (const int cell : component_) {
    const int row = cell / width - box.first_row + margin;
    const int column = cell % width - box.first_column + margin;
    if (isPeak(row, column, columns)) {
      candidates_.push_back({row, column, surface_[at(row, column, columns)]});
    }
  }
  std::sort(candidates_.begin(), candidates_.end(), [](const Peak& a, const Peak& b) {
    if (a.value != b.value) return a.value > b.value;
    return a.row != b.row ? a.row < b.row : a.column < b.column;
  });
  for (const Peak& peak : candidates_) {
    if (standsApart(peak, columns)) peaks_.push_back(peak);
  }
  for (Peak& peak : peaks_) {
    peak.row += box.first_row - margin;
    peak.column += box.first_column - margin;
  }
}

bool WorldBlobFinder::isPeak(int row, int column, int columns) const {
  const float value = surface_[at(row, column, columns)];
  for (int r = row - kPeakRadius; r <= row + kPeakRadius; ++r) {
    for (int c = column - kPeakRadius; c <= column + kPeakRadius; ++c) {
      if (surface_[at(r, c, columns)] > value) return false;
    }
  }
  return true;
}

// Far enough from every higher peak, with a valley on the straight line between.
bool WorldBlobFinder::standsApart(const Peak& peak, int columns) const {
  for (const Peak& other : peaks_) {
    const int rows = other.row - peak.row;
    const int across = other.column - peak.column;
    if (std::hypot(rows, across) < min_separation_cells_) return false;
    const int steps = std::max(std::abs(rows), std::abs(across));
    float lowest = peak.value;
    for (int i = 1; i < steps; ++i) {
      const double part = static_cast<double>(i) / steps;
      const int row = peak.row + static_cast<int>(std::lround(part * rows));
      const int column = peak.column + static_cast<int>(std::lround(part * across));
      lowest = std::min(lowest, surface_[at(row, column, columns)]);
    }
    if (lowest > static_cast<float>(params_.max_valley) * peak.value) return false;
  }
  return true;
}

// Gives each cell to its nearest peak and adds one blob a peak.
void WorldBlobFinder::addParts(const PlanView& view, const Box& box,
                               std::vector<WorldBlob>& blobs) {
  const auto first = blobs.size();
  blobs.resize(first + peaks_.size());
  moments_.assign(peaks_.size(), Eigen::Matrix2d::Zero());
  const int width = view.width();
  // Moments are taken about the box's corner, to keep their digits.
  const Eigen::Vector2d corner =
      view.center(static_cast<int>(at(box.first_row, box.first_column, width)));
  for (const int cell : component_) {
    std::size_t owner = 0;
    if (peaks_.size() > 1) {
      int nearest = std::numeric_limits<int>::max();
      for (std::size_t k = 0; k < peaks_.size(); ++k) {
        const int rows = cell / width - peaks_[k].row;
        const int across = cell % width - peaks_[k].column;
        const int square = rows * rows + across * across;
        if (square < nearest) {
          nearest = square;
          owner = k;
        }
      }
    }
    const PlanCell& from = view[cell];
    WorldBlob& blob = blobs[first + owner];
    const double area = std::max(static_cast<double>(from.area_m2), kLeastArea_m2);
    const Eigen::Vector2d place = view.center(cell) - corner;
    blob.position_m += area * place;
    moments_[owner] += area * place * place.transpose();
    blob.area_m2 += area;
    blob.score += static_cast<double>(from.max_height_m);
    blob.max_height_m = std::max(blob.max_height_m, static_cast<double>(from.max_height_m));
    blob.appearance += static_cast<double>(from.appearance);
    blob.points += from.points;
    ++blob.cells;
    labels_[static_cast<std::size_t>(cell)] = static_cast<int>(first + owner);
  }
  for (std::size_t k = 0; k < peaks_.size(); ++k) {
    WorldBlob& blob = blobs[first + k];
    const Eigen::Vector2d mean = blob.position_m / blob.area_m2;
    const Eigen::Matrix2d spread = moments_[k] / blob.area_m2 - mean * mean.transpose();
    const double half_trace = 0.5 * spread.trace();
    const double root = std::sqrt(std::max(0.0, half_trace * half_trace - spread.determinant()));
    blob.extent_m = 4.0 * std::sqrt(std::max(0.0, half_trace + root));
    blob.position_m = corner + mean;
    blob.appearance /= blob.points;
  }
}

void WorldBlobFinder::sortByScore(std::vector<WorldBlob>& blobs) {
  order_.resize(blobs.size());
  rank_.resize(blobs.size());
  std::iota(order_.begin(), order_.end(), 0);
  std::sort(order_.begin(), order_.end(), [&](int a, int b) {
    const WorldBlob& first = blobs[static_cast<std::size_t>(a)];
    const WorldBlob& second = blobs[static_cast<std::size_t>(b)];
    return first.score != second.score ? first.score > second.score : a < b;
  });
  sorted_.clear();
  for (std::size_t i = 0; i < order_.size(); ++i) {
    sorted_.push_back(blobs[static_cast<std::size_t>(order_[i])]);
    rank_[static_cast<std::size_t>(order_[i])] = static_cast<int>(i);
  }
  blobs.assign(sorted_.begin(), sorted_.end());
  for (const int cell : touched_) {
    int& label = labels_[static_cast<std::size_t>(cell)];
    if (label >= 0) label = rank_[static_cast<std::size_t>(label)];
  }
}

}  // namespace heel
