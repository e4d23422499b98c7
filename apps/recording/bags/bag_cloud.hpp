// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The clouds of messages.
#pragma once

#include <heel/apps/bag/messages.hpp>
#include <heel/cloud/color_cloud.hpp>

namespace heel {

/// @throws std::runtime_error  half a sentence, if it has no colours, no finite points, or fewer
///         bytes than it says.
ColorCloud::ConstPtr toColorCloud(const PointCloud2Msg& message);

/// A cloud as a message, with the fields x, y, z and rgb.
PointCloud2Msg toCloudMsg(const ColorCloud& cloud);

}  // namespace heel
