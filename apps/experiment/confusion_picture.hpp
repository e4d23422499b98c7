// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Confusion matrices, drawn.
#pragma once

#include <opencv2/core/mat.hpp>

#include <string>
#include <vector>

namespace heel {

/// One matrix of the picture.
struct ConfusionPanel {
  std::string title;
  std::string note;                 ///< Under the title.
  std::vector<std::string> people;  ///< Of the rows (whose model) and of the columns (who is seen).
  std::vector<double> shares;       ///< Row by row, in [0, 1]; NaN leaves a cell empty.
};

/// Matrices side by side, four in a row. On the diagonal, where much is right, cells turn green;
/// off it, where anything is wrong, they turn red. Each cell shows its share in percent.
/// @throws std::invalid_argument  if a panel has not people * people shares.
cv::Mat drawConfusion(const std::string& title, const std::vector<ConfusionPanel>& panels);

}  // namespace heel
