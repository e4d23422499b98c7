// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/stereo_params.hpp>

#include <stdexcept>
#include <string>

namespace heel {
namespace {

void requireParam(bool holds, const char* rule) {
  if (!holds) throw std::invalid_argument(std::string("StereoMatcherParams: ") + rule);
}

}  // namespace

StereoMatcherParams checked(const StereoMatcherParams& p) {
  requireParam(p.disparities > 0 && p.disparities <= 256 && p.disparities % 16 == 0,
               "disparities must be a multiple of 16, at most 256");
  requireParam(p.block_size % 2 == 1 && p.block_size >= 1 && p.block_size <= 5,
               "block_size must be 1, 3 or 5");
  requireParam(p.p1 > 0 && p.p2 > p.p1 && p.p2 <= 900, "0 < p1 < p2 <= 900 must hold");
  requireParam(p.prefilter_cap % 2 == 1 && p.prefilter_cap >= 15 && p.prefilter_cap <= 63,
               "prefilter_cap must be odd, from 15 to 63");
  requireParam(p.uniqueness_percent >= 0 && p.uniqueness_percent < 100,
               "uniqueness_percent must be from 0 to 99");
  requireParam(p.max_left_right_difference >= 1, "max_left_right_difference must be at least 1");
  requireParam(p.speckle_size >= 0, "speckle_size can't be negative");
  requireParam(p.margin_px >= 0, "margin_px can't be negative");
  requireParam(p.min_support >= 0.0 && p.min_support <= 1.0, "min_support must be from 0 to 1");
  return p;
}

}  // namespace heel
