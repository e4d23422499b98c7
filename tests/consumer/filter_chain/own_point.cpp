// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

// PCL's way, and Heel's, to bring the bodies of templates: before any of their headers.
#define PCL_NO_PRECOMPILE

#include <pcl/point_types.h>
#include <pcl/register_point_struct.h>

#include <cstdint>

namespace consumer {

/// What our robot's camera says of a point.
struct EIGEN_ALIGN16 GradedPoint {
  PCL_ADD_POINT4D
  PCL_ADD_RGB
  float confidence = 1.0F;
  std::uint16_t row = 0;
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};

}  // namespace consumer

// clang-format off
POINT_CLOUD_REGISTER_POINT_STRUCT(consumer::GradedPoint,
    (float, x, x)(float, y, y)(float, z, z)(float, rgb, rgb)
    (float, confidence, confidence)(std::uint16_t, row, row))
// clang-format on

#include "chain.hpp"

void consumer::runChainOnOwnPoint() { runChain<GradedPoint>(); }
