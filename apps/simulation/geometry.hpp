// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// All that never moves in a scene, as flat faces and upright cylinders.
#pragma once

#include <heel/apps/simulation/material.hpp>
#include <heel/apps/simulation/scene.hpp>

#include <Eigen/Geometry>

#include <vector>

namespace heel {

/// A parallelogram with right angles, seen from the side that its normal points to.
struct Face {
  Eigen::Vector3f origin;
  Eigen::Vector3f edge_u;  ///< From the origin along the texture's width.
  Eigen::Vector3f edge_v;  ///< From the origin along the texture's height.
  Eigen::Vector3f normal;  ///< Unit length.
  int material = 0;
  Rgb tint = Rgb::Ones();
  float texture_u_m = 0.0F;  ///< Where the texture starts, so that pieces of a wall continue it.
};

/// An upright cylinder with flat ends.
struct Pillar {
  Eigen::Vector3f base;
  float radius_m = 0.0F;
  float height_m = 0.0F;
  int material = 0;
  Rgb tint = Rgb::Ones();
};

/// Faces and pillars of a scene, with the materials that they are made of.
struct Geometry {
  std::vector<Face> faces;
  std::vector<Pillar> pillars;
  MaterialLibrary materials;
};

Geometry makeGeometry(const Scene& scene);

}  // namespace heel
