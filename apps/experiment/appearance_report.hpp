// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The appearance experiment's figures, summed up and as files.
#pragma once

#include <heel/apps/experiment/appearance_experiment.hpp>
#include <heel/apps/output/output.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace heel {

/// One line of the table: a model, and by which rule a run counts as a detection.
struct AppearanceRow {
  std::string name;
  std::size_t model = 0;  ///< Index into WardrobeRuns::models.
  DetectionRule rule = DetectionRule::kFollowed;
  int wardrobes = 0;
  ConfusionCount all;           ///< Everyone against everyone.
  ConfusionCount without_pair;  ///< The second of the similar pair left out, as the paper does.
  Proportion clean;             ///< Wardrobes without any false positive or negative,
  Proportion clean_without;     ///< and the same without the second of the pair.
  Proportion identified;        ///< Recordings most like their own person's model.
  Proportion pairs;             ///< Confusions in which the target scored higher side by side.
  int elsewhere = 0;            ///< Frames in which a place without a person was followed,
  int frames = 0;               ///< of so many in which somebody was in view.
};

/// A line for each model, after one for the paper's model by the paper's rule. All wardrobes must
/// have been run with the same models.
std::vector<AppearanceRow> appearanceTable(const std::vector<WardrobeRuns>& wardrobes,
                                           double min_share = kDetectedShare);

/// The tables (see writeAppearanceTables()), and what follows from them: summary.json and
/// confusion.png: of one wardrobe the share of the time in which each was followed, of several the
/// share of the wardrobes in which each was detected.
/// @param folder  Of the output: they go there.
/// @throws OutputError  as CsvWriter.
void writeAppearanceFiles(const Output& output, const std::string& folder,
                          const std::vector<WardrobeRuns>& measured);

/// Writes people.csv (what each wears, and how they were learned), runs.csv (one line a run) and
/// pairs.csv (one a two-people test).
/// @param folder  Of the output: they go there.
/// @throws OutputError  as CsvWriter.
void writeAppearanceTables(const Output& output, const std::string& folder,
                           const std::vector<WardrobeRuns>& wardrobes);

/// Reads them, in the order in which they were written.
/// @throws std::runtime_error  that names the file and what is wrong with it.
std::vector<WardrobeRuns> readAppearanceTables(const std::filesystem::path& folder);

}  // namespace heel
