// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The runs of an experiment in following, their table and their counts.
#pragma once

#include <heel/apps/output/output.hpp>
#include <heel/apps/results/follow_log.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace heel {

/// One run of an experiment.
struct FollowEpisode {
  std::string name;  ///< "Experiment 1" in Table 1; else what tells it from the others.
  unsigned long seed = 0;
  std::string plan;
  FollowSummary summary;
  std::string cause;    ///< Of a failure, in a few words; empty if the person was reached.
  std::string command;  ///< The command line that repeats it.
};

/// All that `heel experiment follow` found.
struct FollowExperiment {
  std::string title = "Person following";
  std::vector<std::string> plans;       ///< In the order in which they are shown: "paper", ...
  std::vector<FollowEpisode> table1;    ///< The paper's experiments with each of the plans.
  std::vector<FollowEpisode> episodes;  ///< At random, with any of the plans.
  double max_speed_mps = 0.3;
  std::string command;
};

/// The least share of the time with somebody else that is a failure.
constexpr double kWrongShareLimit = 0.01;

/// Whether an episode counts as failed: the person was not reached, or the robot touched something,
/// or somebody else was followed for kWrongShareLimit of the time or more.
bool isFailure(const FollowEpisode& episode);

/// Figures of all episodes with one plan.
struct EpisodeCounts {
  int episodes = 0;
  int reached = 0;
  int with_contact = 0;  ///< By the robot.
  int contacts_by_robot = 0;
  int contacts_by_people = 0;
  double elapsed_s = 0.0;
  double seek_s = 0.0;
  double wrong_person_s = 0.0;
  double near_others_s = 0.0;
  double distance_m = 0.0;
  double wrongShare() const { return elapsed_s > 0.0 ? wrong_person_s / elapsed_s : 0.0; }
};
EpisodeCounts countEpisodes(const std::vector<FollowEpisode>& episodes, const std::string& plan);

/// Writes a row for each of the episodes, those of Table 1 first.
/// @throws OutputError  as OutputFile.
void writeEpisodesCsv(const OutputPath& file, const FollowExperiment& experiment);

/// Adds the episodes of such a table: all that the page shows of them.
/// @throws std::runtime_error  as CsvReader.
void readEpisodesCsv(const std::filesystem::path& file, FollowExperiment& experiment);

}  // namespace heel
