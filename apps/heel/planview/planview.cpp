// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/film/video_writer.hpp>
#include <heel/apps/heel/commands.hpp>
#include <heel/apps/heel/planview/cloud_plan.hpp>
#include <heel/apps/heel/shared/cloud_summary.hpp>
#include <heel/apps/recording/clouds/cloud_file.hpp>
#include <heel/segmentation/appearance_model_io.hpp>

#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

namespace heel {
namespace {

namespace fs = std::filesystem;

struct PlanViewOptions {
  fs::path model;
  fs::path out;
  CloudBatch batch;
  std::string up = "-y";
  std::optional<double> height_m;
  double pitch_deg = 0.0;
  std::vector<double> heights_m;
  CloudPlanParams params;
  bool no_pictures = false;
};

/// What is kept of a cloud's plan; the view itself is not.
struct Planned {
  std::string floor;
  Mounting mounting;
  std::size_t color_points = 0, standing_points = 0, people = 0;
  std::vector<WorldBlob> blobs;
  std::vector<bool> is_person;
  bool has_area = false;
};

CloudPlanParams paramsOf(const PlanViewOptions& options) {
  CloudPlanParams params = options.params;
  params.R_optical_cloud = opticalFromUp(options.up);
  if (options.height_m) params.mounting = {*options.height_m, options.pitch_deg / kDegrees, 0.0};
  if (!options.heights_m.empty()) {
    params.heights = {options.heights_m[0], options.heights_m[1]};
    if (!(params.heights.min_m < params.heights.max_m)) {
      throw std::invalid_argument("--heights: the first must be below the second");
    }
  }
  return params;
}

Planned planOne(const fs::path& in, const OutputPath& picture, const AppearanceModel* model,
                const CloudPlanParams& params, const PlanViewOptions& options, CloudFate& fate) {
  const CloudFile cloud = readCloud(in);
  fate.facts = cloud.facts;
  const CloudPlan plan = planCloud(in, cloud, model, params);
  if (!options.no_pictures) writePicture(picture, drawPlanView(plan, in.filename().string()));
  fate.outcome = plan.blobs.empty() ? "nothing" : "drawn";
  if (plan.blobs.empty()) {
    fate.reason = in.string() + (plan.color_points == 0      ? ": no point has the person's colours"
                                 : plan.standing_points == 0 ? ": no point is at a person's height"
                                                             : ": no blob is large enough");
  }
  return {toText(plan.floor), plan.mounting, plan.color_points, plan.standing_points,
          plan.people(),      plan.blobs,    plan.is_person,    plan.has_camera};
}

void addRows(const fs::path& file, const Planned& planned, CsvWriter& blobs) {
  for (std::size_t i = 0; i < planned.blobs.size(); ++i) {
    const WorldBlob& blob = planned.blobs[i];
    blobs.text(file.string()).integer(static_cast<std::int64_t>(i) + 1);
    blobs.number(blob.position_m.x(), 3).number(blob.position_m.y(), 3);
    blobs.number(blob.max_height_m, 3).integer(blob.points).integer(blob.cells);
    if (planned.has_area) {
      blobs.number(blob.area_m2, 4);
    } else {
      blobs.text("");
    }
    blobs.number(blob.extent_m, 3).number(blob.score, 2).flag(planned.is_person[i]).endRow();
  }
}

void addFields(const Planned& planned, CsvWriter& row) {
  if (planned.floor.empty()) {
    for (int i = 0; i < 7; ++i) row.text("");
    return;
  }
  row.text(planned.floor).number(planned.mounting.height_m, 3);
  row.number(planned.mounting.pitch_rad * kDegrees, 2);
  row.integer(static_cast<std::int64_t>(planned.color_points));
  row.integer(static_cast<std::int64_t>(planned.standing_points));
  row.integer(static_cast<std::int64_t>(planned.blobs.size()));
  row.integer(static_cast<std::int64_t>(planned.people));
}

void run(const PlanViewOptions& options) {
  const CloudPlanParams params = paramsOf(options);
  std::optional<AppearanceModel> model;
  if (!options.model.empty()) model = loadAppearance(options.model);
  const AppearanceModel* chosen = model ? &*model : nullptr;
  const auto clouds = findClouds(options.batch.names);
  const auto pictures = resultNames(clouds, ".png");
  std::vector<fs::path> inputs = clouds;
  inputs.push_back(options.model);
  Output output({"planview",
                 OutputKind::kFolder,
                 options.out,
                 std::move(inputs),
                 {"blobs.csv", "summary.csv", "summary.json"}});
  CloudSummary summary(output, {"floor", "origin_height_m", "pitch_deg", "color_points",
                                "standing_points", "blobs", "people"});
  CsvWriter blobs(output / "blobs.csv", {"file", "blob", "x_m", "y_m", "height_m", "points",
                                         "cells", "area_m2", "extent_m", "score", "is_person"});
  std::size_t blob_count = 0, people = 0;
  const std::vector<std::string> failures = workOnClouds(
      "drawing", clouds.size(), options.batch.threads,
      [&](std::size_t i, CloudFate& fate) {
        return planOne(clouds[i], output / pictures[i], chosen, params, options, fate);
      },
      [&](std::size_t i, const CloudFate& fate, const Planned& planned) {
        blob_count += planned.blobs.size();
        people += planned.people;
        summary.add(clouds[i], fate, [&](CsvWriter& row) { addFields(planned, row); });
        addRows(clouds[i], planned, blobs);
      });
  blobs.close();
  summary.close({{"model", options.model.string()},
                 {"up", options.up},
                 {"blobs", blob_count},
                 {"people", people}});
  output.commit(summary.count(CloudFate::kStopped) == 0);
  if (summary.failed() < clouds.size()) {
    std::printf("%zu cloud%s: %s; %zu blobs, %zu of a person's shape\n", clouds.size(),
                clouds.size() == 1 ? "" : "s", summary.outcomes().c_str(), blob_count, people);
    std::printf("results in %s: %sblobs.csv, summary.csv, summary.json\n", output.path().c_str(),
                options.no_pictures ? "" : "pictures, ");
  }
  tellFailures(failures, clouds.size(), summary.count(CloudFate::kStopped));
  if (blob_count == 0) throw NothingFound("there is nobody in the clouds");
}

}  // namespace

void addPlanView(CLI::App& app) {
  auto options = std::make_shared<PlanViewOptions>();
  CLI::App* verb = app.add_subcommand("planview", "Look at clouds from above: who stands where");
  verb->footer(
      "Examples:\n"
      "  heel planview scene.pcd --out out/scene\n"
      "  heel planview 'clouds/*.pcd' --model person.yaml --out out/clouds\n"
      "  heel planview scan.ply --up z --height 0 --out out/scan\n"
      "Writes a picture of each cloud, blobs.csv (places on the floor under the cloud's origin, X\n"
      "forward, Y left), summary.csv and summary.json. The floor is that of the cloud, unless\n"
      "--height, or a camera.yaml beside the cloud, tells where its origin is. Clouds are in a\n"
      "camera's frame (Y down); '--up z' is for those with Z up, '--up z --height 0' for those "
      "whose\n"
      "floor is z = 0. Fails if one of the clouds did; the others are done all the same.");
  addCloudBatch(*verb, options->batch, "PCD or PLY files, folders of them, and patterns in quotes");
  verb->add_option("--model", options->model,
                   "the person, as 'heel learn' wrote it; without one, all points count");
  verb->add_option("--out", options->out, "folder for the results")->required();
  verb->add_option("--up", options->up, "the clouds' axis that points up: x, y, z, -x, -y or -z")
      ->capture_default_str();
  verb->add_option("--height", options->height_m, "of the clouds' origin over the floor [m]")
      ->check(CLI::Range(-100.0, 100.0));
  verb->add_option("--pitch", options->pitch_deg, "how far the camera looks down [deg]")
      ->needs("--height")
      ->capture_default_str();
  verb->add_option("--heights", options->heights_m,
                   "of points that count without a model [m] (default 0.3,2.3)")
      ->delimiter(',')
      ->expected(2)
      ->option_text("LOW,HIGH");
  verb->add_option("--range", options->params.plan_view.max_range_m, "how far the plan reaches [m]")
      ->check(CLI::Range(0.1, 1000.0))
      ->capture_default_str();
  verb->add_option("--cell", options->params.plan_view.cell_size_m, "edge of a cell [m]")
      ->check(CLI::Range(0.001, 10.0))
      ->capture_default_str();
  verb->add_flag("--no-pictures", options->no_pictures, "write the tables only");
  verb->callback([options] { run(*options); });
}

}  // namespace heel
