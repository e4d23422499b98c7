// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

// Did a box of this size, driven as `heel follow --random` says, touch anything that stands?
//   fcl_audit LENGTH WIDTH HEIGHT RESULT...
// Each result is a folder of such a run. All true poses, 2 cm of the body apart, are checked by FCL
// against the home of the run's seed in voxels of 2 cm: these are rather too large than too small.

#include <heel/apps/experiment/random_home.hpp>
#include <heel/apps/output/csv_file.hpp>
#include <heel/apps/simulation/scene_map.hpp>
#include <heel/mapping/body_check.hpp>

#include <nlohmann/json.hpp>
#include <octomap/OcTree.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <optional>
#include <vector>

int main(int count, char** words) {
  using namespace heel;
  if (count < 5) {
    std::fprintf(stderr, "fcl_audit LENGTH WIDTH HEIGHT RESULT...\n");
    return 2;
  }
  RobotBody body;
  body.footprint = BoxFootprint{std::atof(words[1]), std::atof(words[2]), 0.0};
  body.top_m = std::atof(words[3]);
  int touches = 0;
  try {
    for (int i = 4; i < count; ++i) {
      const std::filesystem::path folder = words[i];
      std::ifstream summary(folder / "summary.json");
      const auto seed = nlohmann::json::parse(summary).at("seed").get<std::uint64_t>();
      Scene scene = randomEpisode(seed, HEEL_SCENES);
      for (Furniture& piece : scene.furniture) piece.in_map = true;
      const BodyCheck world(body, *wallMapOf(scene, 0.02).tree());
      CsvReader csv(folder / "follow.csv", {"x_m", "y_m", "yaw_rad", "stamp_s"});
      std::vector<FloorPose> driven;
      std::vector<double> stamps_s;
      while (csv.next()) {
        driven.push_back({{csv.number(0), csv.number(1)}, csv.number(2)});
        stamps_s.push_back(csv.number(3));
      }
      const std::optional<std::size_t> touch = world.firstCollision(driven);
      touches += touch ? 1 : 0;
      if (touch) {
        std::printf("%s: touches at %.1f s\n", folder.c_str(), stamps_s[*touch]);
      } else {
        std::printf("%s: clear, %zu poses\n", folder.c_str(), driven.size());
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return touches > 0 ? 1 : 0;
}
