// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// How far a word is from another: for who wants to say what was meant.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace heel {

/// How many letters must be put in, left out, changed or swapped with the next to make `b` of `a`.
inline std::size_t typosBetween(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> typos(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      std::size_t& least = typos[i][j] = std::max(i, j);
      if (i == 0 || j == 0) continue;
      least = std::min({typos[i - 1][j] + 1, typos[i][j - 1] + 1,
                        typos[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        least = std::min(least, typos[i - 2][j - 2] + 1);
      }
    }
  }
  return typos[a.size()][b.size()];
}

/// "; did you mean --model?", if a name is near enough to what was written: a third of its letters
/// may be wrong. Otherwise nothing.
inline std::string didYouMean(const std::string& written, const std::vector<std::string>& names) {
  const std::string* best = nullptr;
  std::size_t least = written.size() / 3 + 1;
  for (const std::string& name : names) {
    const std::size_t typos = typosBetween(written, name);
    if (typos >= least) continue;
    best = &name;
    least = typos;
  }
  return best == nullptr ? std::string() : "; did you mean " + *best + "?";
}

}  // namespace heel
