// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Who was looked at enough.
#pragma once

#include <algorithm>
#include <vector>

namespace heel {

/// Keeps how much each track was looked at, so that nobody is looked at for ever. No allocation
/// once warm.
class Attention {
 public:
  void clear() { looks_.clear(); }

  /// Another share of a look that is enough.
  void pay(int track_id, double share) { lookAt(track_id).share += share; }

  bool isEnough(int track_id) const {
    return std::any_of(looks_.begin(), looks_.end(), [&](const Look& look) {
      return look.track_id == track_id && look.share >= 1.0;
    });
  }

 private:
  struct Look {
    int track_id = 0;
    double share = 0.0;
  };

  Look& lookAt(int track_id) {
    const auto known = std::find_if(looks_.begin(), looks_.end(),
                                    [&](const Look& look) { return look.track_id == track_id; });
    return known != looks_.end() ? *known : looks_.emplace_back(Look{track_id, 0.0});
  }

  std::vector<Look> looks_;
};

}  // namespace heel
