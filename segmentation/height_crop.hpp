// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Keeps the points at the heights of a standing person: PCL's own PassThrough on z.
#pragma once

#include <heel/cloud/color_cloud.hpp>

#include <pcl/filters/passthrough.h>

namespace heel {

/// Heights over the floor [m]. The upper limit leaves room over a tall person, so that a wall shows
/// itself by reaching it.
struct HeightCropParams {
  double min_m = 0.3;  ///< Lower points are left out: the floor's noise, and most of the feet.
  double max_m = 2.3;  ///< Higher points are left out; lower this under a low ceiling.
};

/// The height stage of the chain. Holds PCL's filter, so that its memory is reused.
class HeightCrop {
 public:
  /// @throws std::invalid_argument  if the limits are not finite or not in order.
  explicit HeightCrop(const HeightCropParams& params = {});

  /// Keeps, of `indices` (of the whole cloud if null), those at the right heights, in order.
  /// @param cloud  In a frame whose z is the height over the floor. Points without position go.
  /// @param kept   Out; may be the vector that `indices` points to.
  void apply(const ColorCloud::ConstPtr& cloud, const pcl::IndicesPtr& indices, pcl::Indices& kept);

 private:
  pcl::PassThrough<pcl::PointXYZRGB> pass_;
};

}  // namespace heel
