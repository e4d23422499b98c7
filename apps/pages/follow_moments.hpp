// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The moments of a run, for the script of its page.
#pragma once

#include <heel/apps/pages/follow_map.hpp>
#include <heel/apps/pages/state_tones.hpp>
#include <heel/apps/results/follow_log.hpp>

#include <cstddef>
#include <string>

namespace heel {

struct FollowMoments {
  std::size_t count = 0;
  std::string json;  ///< May stand in a script element; follow.js says what is in it.
};

/// @param most  Longer runs are thinned out evenly to about as many.
FollowMoments followMoments(const FollowLog& log, const MapFrame& frame, StateTones& tones,
                            std::size_t most);

}  // namespace heel
