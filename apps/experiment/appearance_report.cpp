// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/appearance_report.hpp>
#include <heel/apps/experiment/confusion_matrix.hpp>
#include <heel/apps/film/video_writer.hpp>
#include <heel/apps/output/csv_file.hpp>
#include <heel/apps/results/result_files.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <stdexcept>

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
                 std::size_t i, std::size_t j) {
  const auto matrixOf = [&](const WardrobeRuns& wardrobe) -> const ConfusionMatrix& {
    return wardrobe.models[row.model].matrix;
  };
  if (wardrobes.size() == 1) return matrixOf(wardrobes.front()).share(i, j, row.rule);
  Proportion detected;
  for (const WardrobeRuns& wardrobe : wardrobes) {
    detected.add(matrixOf(wardrobe).detected(i, j, row.rule, kDetectedShare));
  }
  return detected.share();
}

cv::Mat drawMatrices(const std::vector<WardrobeRuns>& wardrobes) {
  std::vector<ConfusionPanel> panels;
  for (const AppearanceRow& row : appearanceTable(wardrobes)) {
    ConfusionPanel& panel = panels.emplace_back();
    panel.title = row.name;
    panel.note = std::to_string(row.all.false_negatives.count) + " FN, " +
                 std::to_string(row.all.false_positives.count) + " FP";
    panel.people = wardrobes.front().models[row.model].matrix.people();
    for (std::size_t i = 0; i < panel.people.size(); ++i) {
      for (std::size_t j = 0; j < panel.people.size(); ++j) {
        panel.shares.push_back(cellShare(wardrobes, row, i, j));
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
                          const std::vector<WardrobeRuns>& measured) {
  if (measured.empty()) return;
  writeAppearanceTables(output, folder, measured);
  const auto wardrobes = readAppearanceTables((output / folder).written);
  nlohmann::ordered_json summary;
  summary["wardrobes"] = wardrobes.size();
  summary["min_share"] = kDetectedShare;
  for (const AppearanceRow& row : appearanceTable(wardrobes)) {
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
  writePicture(output / (folder + "/confusion.png"), drawMatrices(wardrobes));
}

namespace {

using Columns = std::vector<std::string>;

// What is between 0 and 1 and compared has so many decimals.
constexpr int kDecimals = 6;

const Columns& peopleColumns() {
  static const Columns columns = {"wardrobe", "person",         "top",           "trousers", "hair",
                                  "skin",     "learned_frames", "learning_ended"};
  return columns;
}

const Columns& runsColumns() {
  static const Columns columns = {"wardrobe",        "model",        "model_of",
                                  "person",          "similar_pair", "frames_in_view",
                                  "frames_followed", "frames_blob",  "frames_elsewhere",
                                  "appearance",      "detected"};
  return columns;
}

const Columns& pairsColumns() {
  static const Columns columns = {"wardrobe",         "model",
                                  "target",           "other",
                                  "frames",           "target_appearance",
                                  "other_appearance", "target_blob_score",
                                  "other_blob_score", "followed_target",
                                  "followed_other",   "target_higher"};
  return columns;
}

void writePeople(const OutputPath& file, const std::vector<WardrobeRuns>& wardrobes) {
  CsvWriter csv(file, peopleColumns());
  for (const WardrobeRuns& wardrobe : wardrobes) {
    for (const Acquired& someone : wardrobe.acquired) {
      csv.integer(static_cast<std::int64_t>(wardrobe.seed)).text(someone.person);
      for (const std::string& color : someone.colors) csv.text(color);
      csv.integer(someone.frames).text(someone.end).endRow();
    }
  }
  csv.close();
}

void writeRuns(const OutputPath& file, const std::vector<WardrobeRuns>& wardrobes) {
  CsvWriter csv(file, runsColumns());
  for (const WardrobeRuns& wardrobe : wardrobes) {
    for (const ModelRuns& runs : wardrobe.models) {
      const auto& people = runs.matrix.people();
      for (std::size_t i = 0; i < people.size(); ++i) {
        for (std::size_t j = 0; j < people.size(); ++j) {
          const DetectionRun& run = runs.matrix.at(i, j);
          csv.integer(static_cast<std::int64_t>(wardrobe.seed))
              .text(runs.model)
              .text(people[i])
              .text(people[j])
              .flag(i != j && std::max(i, j) <= kLikeTheFirst)
              .integer(run.frames_in_view)
              .integer(run.followed)
              .integer(run.blob)
              .integer(run.elsewhere)
              .number(run.appearance(), kDecimals)
              .flag(runs.matrix.detected(i, j, DetectionRule::kFollowed, kDetectedShare))
              .endRow();
        }
      }
    }
  }
  csv.close();
}

void writePairs(const OutputPath& file, const std::vector<WardrobeRuns>& wardrobes) {
  CsvWriter csv(file, pairsColumns());
  for (const WardrobeRuns& wardrobe : wardrobes) {
    for (const ModelRuns& runs : wardrobe.models) {
      for (const PairTest& pair : runs.pairs) {
        csv.integer(static_cast<std::int64_t>(wardrobe.seed))
            .text(runs.model)
            .text(runs.matrix.people()[pair.target])
            .text(runs.matrix.people()[pair.other])
            .integer(pair.frames)
            .number(pair.target_appearance, kDecimals)
            .number(pair.other_appearance, kDecimals)
            .number(pair.target_blob_score, 1)
            .number(pair.other_blob_score, 1)
            .integer(pair.followed_target)
            .integer(pair.followed_other)
            .flag(pair.targetScoresHigher())
            .endRow();
      }
    }
  }
  csv.close();
}

/// A run of runs.csv, and whose.
struct RunRow {
  std::string model_of, person;
  DetectionRun run;
};

/// @throws std::runtime_error  if it is not everyone's model against everyone.
ConfusionMatrix matrixOf(const std::vector<RunRow>& rows, const std::string& what) {
  std::vector<std::string> people;
  for (const RunRow& row : rows) {
    if (people.empty() || row.model_of != people.back()) people.push_back(row.model_of);
  }
  ConfusionMatrix matrix(people);
  const std::size_t n = people.size();
  bool is_whole = rows.size() == n * n;
  for (std::size_t i = 0; is_whole && i < rows.size(); ++i) {
    is_whole = rows[i].model_of == people[i / n] && rows[i].person == people[i % n];
    matrix.at(i / n, i % n) = rows[i].run;
  }
  if (!is_whole) throw std::runtime_error(what + ": not everyone's model against everyone");
  return matrix;
}

std::vector<WardrobeRuns> readRuns(const std::filesystem::path& file) {
  std::vector<WardrobeRuns> wardrobes;
  std::vector<RunRow> rows;  // of one model in one wardrobe
  std::uint64_t seed = 0;
  std::string model;
  const auto endModel = [&] {
    if (rows.empty()) return;
    if (wardrobes.empty() || wardrobes.back().seed != seed) wardrobes.emplace_back().seed = seed;
    const std::string what = file.string() + ": wardrobe " + std::to_string(seed) + ", " + model;
    wardrobes.back().models.push_back({model, matrixOf(rows, what), {}});
    rows.clear();
  };
  CsvReader csv(file, runsColumns());
  while (csv.next()) {
    const auto of_seed = static_cast<std::uint64_t>(csv.integer(0));
    if (of_seed != seed || csv.text(1) != model) endModel();
    seed = of_seed;
    model = csv.text(1);
    DetectionRun& run = rows.emplace_back(RunRow{csv.text(2), csv.text(3), {}}).run;
    run.frames_in_view = static_cast<int>(csv.integer(5));
    run.followed = static_cast<int>(csv.integer(6));
    run.blob = static_cast<int>(csv.integer(7));
    run.elsewhere = static_cast<int>(csv.integer(8));
    run.appearance_sum = csv.number(9) * run.frames_in_view;
  }
  endModel();
  return wardrobes;
}

/// What has that value in a list; it must be there.
template <typename List, typename IsIt>
auto& found(List& list, const std::filesystem::path& file, const IsIt& isIt) {
  const auto it = std::find_if(list.begin(), list.end(), isIt);
  if (it == list.end()) throw std::runtime_error(file.string() + ": other runs than runs.csv");
  return *it;
}

WardrobeRuns& wardrobeOf(const CsvReader& csv, std::vector<WardrobeRuns>& wardrobes,
                         const std::filesystem::path& file) {
  const auto seed = static_cast<std::uint64_t>(csv.integer(0));
  return found(wardrobes, file, [&](const WardrobeRuns& runs) { return runs.seed == seed; });
}

void readPairs(const std::filesystem::path& file, std::vector<WardrobeRuns>& wardrobes) {
  CsvReader csv(file, pairsColumns());
  while (csv.next()) {
    ModelRuns& runs = found(wardrobeOf(csv, wardrobes, file).models, file,
                            [&](const ModelRuns& of) { return of.model == csv.text(1); });
    const auto& people = runs.matrix.people();
    const auto person = [&](std::size_t column) {
      const std::string& name = csv.text(column);
      const auto& it = found(people, file, [&](const std::string& of) { return of == name; });
      return static_cast<std::size_t>(&it - people.data());
    };
    PairTest& pair = runs.pairs.emplace_back();
    pair.target = person(2);
    pair.other = person(3);
    pair.frames = static_cast<int>(csv.integer(4));
    pair.target_appearance = csv.number(5);
    pair.other_appearance = csv.number(6);
    pair.target_blob_score = csv.number(7);
    pair.other_blob_score = csv.number(8);
    pair.followed_target = static_cast<int>(csv.integer(9));
    pair.followed_other = static_cast<int>(csv.integer(10));
  }
}

void readPeople(const std::filesystem::path& file, std::vector<WardrobeRuns>& wardrobes) {
  CsvReader csv(file, peopleColumns());
  while (csv.next()) {
    wardrobeOf(csv, wardrobes, file)
        .acquired.push_back({csv.text(1),
                             {csv.text(2), csv.text(3), csv.text(4), csv.text(5)},
                             static_cast<int>(csv.integer(6)),
                             csv.text(7)});
  }
}

}  // namespace

void writeAppearanceTables(const Output& output, const std::string& folder,
                           const std::vector<WardrobeRuns>& wardrobes) {
  writePeople(output / (folder + "/people.csv"), wardrobes);
  writeRuns(output / (folder + "/runs.csv"), wardrobes);
  writePairs(output / (folder + "/pairs.csv"), wardrobes);
}

std::vector<WardrobeRuns> readAppearanceTables(const std::filesystem::path& folder) {
  std::vector<WardrobeRuns> wardrobes = readRuns(folder / "runs.csv");
  readPairs(folder / "pairs.csv", wardrobes);
  readPeople(folder / "people.csv", wardrobes);
  return wardrobes;
}

}  // namespace heel
