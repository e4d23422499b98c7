// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/path.hpp>

#include <cmath>
#include <stdexcept>

namespace heel {

double pathLength(const FloorPath& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

void resample(const FloorPath& path, double step_m, FloorPath& out) {
  if (!(step_m > 0.0)) throw std::invalid_argument("a path's step must be positive");
  out.clear();
  if (path.empty()) return;
  out.push_back(path.front());
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Eigen::Vector2d piece = path[i] - path[i - 1];
    const int parts = static_cast<int>(std::ceil(piece.norm() / step_m - 1e-9));
    for (int k = 1; k < parts; ++k) out.push_back(path[i - 1] + piece * (double(k) / parts));
    if (parts > 0) out.push_back(path[i]);
  }
}

FloorPath resample(const FloorPath& path, double step_m) {
  FloorPath out;
  resample(path, step_m, out);
  return out;
}

}  // namespace heel
