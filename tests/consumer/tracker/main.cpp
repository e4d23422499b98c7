// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/tracking/kalman.hpp>

#include <cmath>
#include <cstdio>

/// A still person at (2, 1) m, of whom nothing but one place is known, is measured 0.2 m further on
/// with the same noise: they are taken to be half way.
int main() {
  const Eigen::Matrix2d noise_m2 = 0.01 * Eigen::Matrix2d::Identity();
  const heel::MotionState seen = heel::startMotion({2.0, 1.0}, noise_m2, 0.5);
  const heel::MotionState again = heel::update(heel::predict(seen, 0.0), {2.2, 1.0}, noise_m2);
  const double error_m = (again.position_m() - Eigen::Vector2d(2.1, 1.0)).norm();
  std::printf("%.12f m from where it must be\n", error_m);
  return error_m < 1e-9 ? 0 : 1;
}
