// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The places of a cloud's points, as files and messages have them.
#pragma once

#include <pcl/PCLPointCloud2.h>

#include <string>

namespace heel {

/// What is wrong with the fields x, y and z, as half a sentence; empty if they are floats of 32 or
/// 64 bits.
std::string wrongWithPlaces(const pcl::PCLPointCloud2& layout);

/// Makes places and normals of 64 bits ones of 32, as PCL's points have them. The points keep their
/// size: what is left of a value is padding. A colour's four bytes that are called signed become
/// unsigned, as PCL has them.
void makePlacesShort(pcl::PCLPointCloud2& cloud);

}  // namespace heel
