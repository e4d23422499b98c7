// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/appearance_report.hpp>
#include <heel/apps/experiment/appearance_tables.hpp>
#include <heel/apps/experiment/confusion_picture.hpp>
#include <heel/apps/film/video_writer.hpp>
#include <heel/apps/results/result_files.hpp>

#include <nlohmann/json.hpp>

#include <array>

namespace heel {
namespace {

bool isClean(const ConfusionCount& count) {
  return count.false_negatives.count + count.false_positives.count == 0;
}

AppearanceRow sumUp(const std::vector<WardrobeRuns>& wardrobes, std::size_t model,
                    DetectionRule rule, double min_share) {
  AppearanceRow row;
  row.name = wardrobes.front().models[model].model;
  row.model = model;
  row.rule = rule;
  for (const WardrobeRuns& wardrobe : wardrobes) {
    const ModelRuns& runs = wardrobe.models[model];
    const ConfusionCount all = runs.matrix.count(rule, min_share);
    const ConfusionCount without = runs.matrix.count(rule, min_share, kLikeTheFirst);
    ++row.wardrobes;
    row.all.add(all);
    row.without_pair.add(without);
    row.identified.add(runs.matrix.identified());
    row.clean.add(isClean(all));
    row.clean_without.add(isClean(without));
    if (rule == DetectionRule::kFollowed) {
      for (const PairTest& pair : runs.pairs) row.pairs.add(pair.targetScoresHigher());
    }
    for (std::size_t i = 0; i < runs.matrix.size(); ++i) {
      for (std::size_t j = 0; j < runs.matrix.size(); ++j) {
        row.elsewhere += runs.matrix.at(i, j).elsewhere;
        row.frames += runs.matrix.at(i, j).frames_in_view;
      }
    }
  }
  return row;
}

nlohmann::ordered_json toJson(const Proportion& proportion) {
  const ShareInterval interval = wilsonInterval(proportion);
  return {{"count", proportion.count},
          {"of", proportion.total},
          {"low_95", interval.low},
          {"high_95", interval.high}};
}

nlohmann::ordered_json toJson(const ConfusionCount& count) {
  return {{"false_negatives", toJson(count.false_negatives)},
          {"false_positives", toJson(count.false_positives)}};
}

/// What a cell of the picture shows, see writeAppearanceFiles().
double cellShare(const std::vector<WardrobeRuns>& wardrobes, const AppearanceRow& row,
                 std::size_t i, std::size_t j, double min_share) {
  const auto matrixOf = [&](const WardrobeRuns& wardrobe) -> const ConfusionMatrix& {
    return wardrobe.models[row.model].matrix;
  };
  if (wardrobes.size() == 1) return matrixOf(wardrobes.front()).share(i, j, row.rule);
  Proportion detected;
  for (const WardrobeRuns& wardrobe : wardrobes) {
    detected.add(matrixOf(wardrobe).detected(i, j, row.rule, min_share));
  }
  return detected.share();
}

cv::Mat drawMatrices(const std::vector<WardrobeRuns>& wardrobes, double min_share) {
  std::vector<ConfusionPanel> panels;
  for (const AppearanceRow& row : appearanceTable(wardrobes, min_share)) {
    ConfusionPanel& panel = panels.emplace_back();
    panel.title = row.name;
    panel.note = std::to_string(row.all.false_negatives.count) + " FN, " +
                 std::to_string(row.all.false_positives.count) + " FP";
    panel.people = wardrobes.front().models[row.model].matrix.people();
    for (std::size_t i = 0; i < panel.people.size(); ++i) {
      for (std::size_t j = 0; j < panel.people.size(); ++j) {
        panel.shares.push_back(cellShare(wardrobes, row, i, j, min_share));
      }
    }
  }
  return drawConfusion(wardrobes.size() == 1
                           ? "Rows: whose model. Columns: who is seen. % of the time followed"
                           : "Rows: whose model. Columns: who is seen. % of " +
                                 std::to_string(wardrobes.size()) + " wardrobes with a detection",
                       panels);
}

}  // namespace

std::vector<AppearanceRow> appearanceTable(const std::vector<WardrobeRuns>& wardrobes,
                                           double min_share) {
  std::vector<AppearanceRow> rows;
  if (wardrobes.empty()) return rows;
  rows.push_back(sumUp(wardrobes, 0, DetectionRule::kBlob, min_share));
  rows.back().name += ", any blob";
  for (std::size_t model = 0; model < wardrobes.front().models.size(); ++model) {
    rows.push_back(sumUp(wardrobes, model, DetectionRule::kFollowed, min_share));
  }
  return rows;
}

void writeAppearanceFiles(const Output& output, const std::string& folder,
                          const std::vector<WardrobeRuns>& measured, double min_share) {
  if (measured.empty()) return;
  writeAppearanceTables(output, folder, measured, min_share);
  const auto wardrobes = readAppearanceTables((output / folder).written);
  nlohmann::ordered_json summary;
  summary["wardrobes"] = wardrobes.size();
  summary["min_share"] = min_share;
  for (const AppearanceRow& row : appearanceTable(wardrobes, min_share)) {
    nlohmann::ordered_json entry;
    entry["model"] = row.name;
    entry["all"] = toJson(row.all);
    entry["without_similar_pair"] = toJson(row.without_pair);
    entry["clean_wardrobes"] = toJson(row.clean);
    entry["clean_wardrobes_without_similar_pair"] = toJson(row.clean_without);
    entry["most_like_own_model"] = toJson(row.identified);
    entry["target_scores_higher"] = toJson(row.pairs);
    entry["frames_on_no_person"] = row.elsewhere;
    entry["frames"] = row.frames;
    summary["models"].push_back(std::move(entry));
  }
  // How much the counts hang on the share that makes a detection.
  for (const double share : std::array<double, 4>{0.1, 0.25, 0.5, 0.75}) {
    for (const AppearanceRow& row : appearanceTable(wardrobes, share)) {
      summary["by_min_share"].push_back({{"min_share", share},
                                         {"model", row.name},
                                         {"false_negatives", row.all.false_negatives.count},
                                         {"false_positives", row.all.false_positives.count}});
    }
  }
  writeJson(output / (folder + "/summary.json"), summary);
  writePicture(output / (folder + "/confusion.png"), drawMatrices(wardrobes, min_share));
}

}  // namespace heel
