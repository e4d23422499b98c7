// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/heel/commands.hpp"
#include "apps/recording/pcd_file.hpp"
#include "apps/report/atomic_file.hpp"
#include "segmentation/appearance_filter.hpp"
#include "segmentation/appearance_model_io.hpp"

#include <CLI/CLI.hpp>
#include <pcl/common/io.h>

#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>
#include <memory>
#include <stdexcept>

namespace heel {
namespace {

struct Options {
  std::filesystem::path model;
  std::filesystem::path in;
  std::filesystem::path out;
  bool negative = false;
  bool keep_organized = false;
};

/// Makes the positions of points NaN, as pcl::FilterIndices does; all else stays.
void blank(const pcl::Indices& indices, pcl::PCLPointCloud2& blob) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const char* name : {"x", "y", "z"}) {
    const auto& field = blob.fields[static_cast<std::size_t>(pcl::getFieldIndex(blob, name))];
    for (const auto i : indices) {
      std::memcpy(&blob.data[static_cast<std::size_t>(i) * blob.point_step + field.offset], &nan,
                  sizeof nan);
    }
  }
  blob.is_dense = 0;
}

void run(const Options& options) {
  if (std::filesystem::weakly_canonical(options.in) ==
      std::filesystem::weakly_canonical(options.out)) {
    throw std::runtime_error(options.out.string() + ": would overwrite the cloud that is filtered");
  }
  const AppearanceModel model = loadAppearance(options.model);
  PcdFile pcd = readPcd(options.in);

  AppearanceFilter<pcl::PointXYZRGB> filter(true);
  filter.setTable(model.filterTable());
  filter.setNegative(options.negative);
  filter.setInputCloud(ColorCloud::ConstPtr(&pcd.cloud, [](const ColorCloud*) {}));
  pcl::Indices kept;
  filter.filter(kept);

  if (kept.empty()) {
    throw std::runtime_error(options.in.string() +
                             ": none of its points passes; no cloud is written");
  }
  if (options.keep_organized) {
    blank(*filter.getRemovedIndices(), pcd.blob);
  } else {
    pcl::PCLPointCloud2 chosen;
    pcl::copyPointCloud(pcd.blob, kept, chosen);
    pcd.blob = std::move(chosen);
  }
  const std::filesystem::path temporary = temporaryBeside(options.out);
  try {
    writePcd(temporary, pcd);
  } catch (const std::runtime_error&) {
    std::filesystem::remove(temporary);
    throw std::runtime_error(options.out.string() + ": the cloud cannot be written");
  }
  commitTemporary(temporary, options.out);
  std::printf("kept %zu of %zu points; wrote %s\n", kept.size(), pcd.cloud.size(),
              options.out.string().c_str());
}

}  // namespace

void addFilter(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* verb =
      app.add_subcommand("filter", "Keep a cloud's points that have a person's colours");
  verb->footer(
      "Example:\n"
      "  heel filter --model person.yaml scene.pcd person_in_scene.pcd\n"
      "Looks at colours only, not at heights. All fields of the cloud are kept.");
  verb->add_option("--model", options->model, "the person, as 'heel learn' wrote it")->required();
  verb->add_option("IN", options->in, "PCD file with colours")->required();
  verb->add_option("OUT", options->out, "PCD file to write")->required();
  verb->add_flag("--negative", options->negative, "keep all other points instead");
  verb->add_flag("--keep-organized", options->keep_organized,
                 "keep the cloud's shape: removed points become NaN");
  verb->callback([options] { run(*options); });
}

}  // namespace heel
