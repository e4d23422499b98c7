// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/commands.hpp>
#include <heel/apps/heel/shared/cloud_summary.hpp>
#include <heel/apps/output/output.hpp>
#include <heel/apps/recording/clouds/cloud_file.hpp>
#include <heel/segmentation/appearance_filter.hpp>
#include <heel/segmentation/appearance_model_io.hpp>

#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

namespace heel {
namespace {

namespace fs = std::filesystem;

struct FilterOptions {
  fs::path model;
  fs::path out;
  CloudBatch batch;
  bool negative = false;
  bool keep_organized = false;
};

/// Filters one cloud into `out`.
/// @return how many points passed.
std::size_t filterCloud(const fs::path& in, const OutputPath& out, const ColorTable& table,
                        const FilterOptions& options, CloudFate& fate) {
  CloudFile cloud = readCloud(in);
  fate.facts = cloud.facts;
  needColors(in, cloud.facts);

  AppearanceFilter<pcl::PCLPointCloud2> filter;
  filter.setTable(table);
  filter.setNegative(options.negative);
  filter.setKeepOrganized(options.keep_organized);
  filter.setInputCloud(pcl::make_shared<pcl::PCLPointCloud2>(cloud.blob));
  pcl::Indices kept;
  filter.filter(kept);
  if (kept.empty()) {
    fate.outcome = "nothing";
    fate.reason = in.string() + ": none of its points passes; no cloud is written";
    return 0;
  }
  filter.filter(cloud.blob);

  writeWith(out, [&](const fs::path& file) { writeCloud(file, cloud); });
  fate.outcome = "written";
  return kept.size();
}

void filterOne(const fs::path& in, const fs::path& out, const FilterOptions& options) {
  Output output({"filter", OutputKind::kFile, out, {in, options.model}});
  CloudFate fate;
  const ColorTable table = loadAppearance(options.model).filterTable();
  const std::size_t kept = filterCloud(in, output.file(), table, options, fate);
  if (kept == 0) throw NothingFound(fate.reason);
  output.commit();
  std::printf("kept %zu of %zu points; wrote %s\n", kept, fate.facts.points(), out.c_str());
}

void filterMany(const FilterOptions& options) {
  const ColorTable table = loadAppearance(options.model).filterTable();
  const auto clouds = findClouds(options.batch.names);
  const auto results = resultNames(clouds);
  std::vector<fs::path> inputs = clouds;
  inputs.push_back(options.model);
  Output output({"filter",
                 OutputKind::kFolder,
                 options.out,
                 std::move(inputs),
                 {"summary.csv", "summary.json"}});
  CloudSummary summary(output, {"points_out", "result"});
  std::size_t points_in = 0, points_out = 0;
  const std::vector<std::string> failures = workOnClouds(
      "filtering", clouds.size(), options.batch.threads,
      [&](std::size_t i, CloudFate& fate) {
        return filterCloud(clouds[i], output / results[i], table, options, fate);
      },
      [&](std::size_t i, const CloudFate& fate, std::size_t kept) {
        points_in += fate.hasFailed() ? 0 : fate.facts.points();
        points_out += kept;
        summary.add(clouds[i], fate, [&](CsvWriter& row) {
          row.integer(static_cast<std::int64_t>(kept));
          row.text(kept > 0 ? results[i] : "");
        });
      });
  summary.close({{"model", options.model.string()},
                 {"negative", options.negative},
                 {"keep_organized", options.keep_organized},
                 {"points_in", points_in},
                 {"points_out", points_out}});
  output.commit(summary.count(CloudFate::kStopped) == 0);
  if (summary.failed() < clouds.size()) {
    std::printf("%zu clouds: %s; kept %zu of %zu points\n", clouds.size(),
                summary.outcomes().c_str(), points_out, points_in);
    std::printf("results in %s: clouds, summary.csv, summary.json\n", output.path().c_str());
  }
  tellFailures(failures, clouds.size(), summary.count(CloudFate::kStopped));
  if (points_out == 0) throw NothingFound("none of the clouds has a point that passes");
}

/// Whether one cloud goes to one file, and to which; else results go to the folder --out.
std::optional<fs::path> singleResult(FilterOptions& options) {
  auto& names = options.batch.names;
  if (options.out.empty()) {
    if (names.size() != 2 || !isCloudName(names[1]) || isPattern(names[0]) ||
        fs::is_directory(names[0])) {
      throw std::invalid_argument("name the folder for the results with --out");
    }
    const fs::path out = names[1];
    names.pop_back();
    return out;
  }
  if (!isCloudName(options.out) || fs::is_directory(options.out)) return std::nullopt;
  if (names.size() != 1 || isPattern(names[0]) || fs::is_directory(names[0])) {
    throw std::invalid_argument(options.out.string() +
                                ": is the name of one cloud; for several, --out is a folder");
  }
  return options.out;
}

void run(FilterOptions& options) {
  if (const auto out = singleResult(options)) {
    filterOne(options.batch.names.front(), *out, options);
  } else {
    filterMany(options);
  }
}

}  // namespace

void addFilter(CLI::App& app) {
  auto options = std::make_shared<FilterOptions>();
  CLI::App* verb =
      app.add_subcommand("filter", "Keep the points of clouds that have a person's colours");
  verb->footer(
      "Examples:\n"
      "  heel filter --model person.yaml scene.pcd person_in_scene.pcd\n"
      "  heel filter --model person.yaml scene.ply --negative --out rest.ply\n"
      "  heel filter --model person.yaml 'clouds/*.pcd' more_clouds --out filtered\n"
      "Looks at colours only, not at heights. All fields of a cloud are kept. Each result has its\n"
      "cloud's name; summary.csv and summary.json tell what became of every cloud. Fails if one\n"
      "of them did; the others are done all the same.");
  verb->add_option("--model", options->model, "the person, as 'heel learn' wrote it")->required();
  addCloudBatch(*verb, options->batch,
                "PCD or PLY files, folders of them, and patterns in quotes; without --out: one "
                "cloud, and the file to write");
  verb->add_option("--out", options->out, "folder for the results, or the file for one cloud's");
  verb->add_flag("--negative", options->negative, "keep all other points instead");
  verb->add_flag("--keep-organized", options->keep_organized,
                 "keep a cloud's shape: removed points become NaN");
  verb->callback([options] { run(*options); });
}

}  // namespace heel
