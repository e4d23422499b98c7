// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/follow_experiment.hpp>
#include <heel/apps/experiment/proportion.hpp>
#include <heel/apps/heel/experiment/experiment_commands.hpp>
#include <heel/apps/heel/experiment/joined_parts.hpp>
#include <heel/apps/heel/shared/arguments.hpp>
#include <heel/apps/heel/shared/terminal.hpp>
#include <heel/apps/output/run_end.hpp>
#include <heel/apps/pages/pages.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace heel {
namespace {

constexpr const char* kEpisodes = "episodes.csv";

struct FollowExperimentOptions {
  std::filesystem::path out;
  std::vector<std::filesystem::path> join;
  std::string config;  // empty: each scene's robot, and the defaults
  FollowExperimentParams params;
};

void printRow(const FollowEpisode& episode) {
  const FollowSummary& s = episode.summary;
  std::printf(
      "%-14s %-7s %-8s %6.2f m %6.1f s  seek %4.0f %%  %.2f m/s  contacts by the robot %d, by "
      "people %d  wrong %.1f s%s%s\n",
      episode.name.c_str(), episode.plan.c_str(), s.outcome.c_str(), s.distance_m, s.elapsed_s,
      100.0 * s.seekShare(), s.moving_speed_mps, s.contacts_by_robot, s.contactsByPeople(),
      s.wrong_person_s, episode.cause.empty() ? "" : "  ", episode.cause.c_str());
  std::fflush(stdout);
}

/// What all runs of an experiment share, as options.
std::string sharedBy(const FollowExperimentOptions& options) {
  std::string shared;
  if (options.params.limit_s != FollowExperimentParams().limit_s) {
    shared += " --limit " + CLI::detail::to_string(options.params.limit_s);
  }
  if (!options.params.rough.empty()) shared += " --rough " + options.params.rough;
  if (!options.config.empty()) shared += " --config " + options.config;
  return shared;
}

FollowExperiment runAll(FollowExperimentOptions& options) {
  options.params.scenes = sceneFolder();
  options.params.plans = planFolder();
  if (!options.config.empty()) {
    options.params.config = loadRobotConfig(robotFile(options.config).string());
  }
  const int runs = (options.params.table1 ? 6 : 0) + options.params.episodes;
  ProgressBar progress("runs", static_cast<std::size_t>(runs));
  std::size_t count = 0;
  FollowExperiment experiment =
      runFollowExperiment(options.params, [&](const FollowEpisode& episode) {
        printRow(episode);
        progress.show(++count);
      });
  const std::string shared = sharedBy(options) + " --out again";
  for (FollowEpisode& episode : experiment.episodes) episode.command += shared;
  return experiment;
}

/// The episodes of results of this experiment, in the order of their seeds.
FollowExperiment joinedEpisodes(const std::vector<std::filesystem::path>& parts) {
  FollowExperiment experiment;
  experiment.plans = experimentPlans();
  for (const std::filesystem::path& part : parts) readEpisodesCsv(part / kEpisodes, experiment);
  sortBySeed(experiment.episodes);
  if (experiment.table1.size() > 6) {
    throw std::runtime_error("two of the parts hold the paper's three experiments");
  }
  return experiment;
}

/// The call that makes all of it again; empty if no single one does.
std::string commandOf(const FollowExperiment& experiment, const std::string& shared) {
  const auto& episodes = experiment.episodes;
  if (!episodes.empty() && episodes.back().seed - episodes.front().seed + 1 != episodes.size()) {
    return {};
  }
  return "heel experiment follow --episodes " + std::to_string(episodes.size()) +
         (episodes.empty() ? "" : " --seed " + std::to_string(episodes.front().seed)) +
         (experiment.table1.empty() ? " --no-table1" : "") + shared + " --out again";
}

void run(FollowExperimentOptions& options) {
  std::vector<std::filesystem::path> inputs = options.join;
  if (!options.config.empty()) inputs.push_back(robotFile(options.config));
  std::optional<Output> output = experimentOutput("follow", options.out, inputs);
  const bool is_joined = !options.join.empty();
  const std::string shared = is_joined ? sharedOptions(options.join) : sharedBy(options);
  FollowExperiment experiment = is_joined ? joinedEpisodes(options.join) : runAll(options);
  writeEpisodesCsv(*output / kEpisodes, experiment);
  if (!is_joined) {
    // What is shown follows from the table, be it made at once or joined.
    experiment.table1.clear();
    experiment.episodes.clear();
    readEpisodesCsv((*output / kEpisodes).written, experiment);
  }
  experiment.command = commandOf(experiment, shared);
  if (isStopRequested()) experiment.title += " (incomplete: it was stopped)";
  const EpisodeCounts all = countEpisodes(experiment.episodes, experiment.plans.back());
  std::vector<PartOf> wrong_s;
  for (const FollowEpisode& e : experiment.episodes) {
    if (e.plan != experiment.plans.back()) continue;
    wrong_s.push_back({e.summary.wrong_person_s, e.summary.elapsed_s});
  }
  const ShareInterval wrong = bootstrapInterval(wrong_s);
  std::printf(
      "random episodes (95 %% intervals): reached %s; with a contact by the robot %s;\n"
      "wrong person %.2f %% of the time (%.2f-%.2f %%), seeking %.0f %%, within 1.2 m of others "
      "%.0f %%\n",
      withInterval({all.reached, all.episodes}).c_str(),
      withInterval({all.with_contact, all.episodes}).c_str(), 100.0 * all.wrongShare(),
      100.0 * wrong.low, 100.0 * wrong.high,
      all.elapsed_s > 0.0 ? 100.0 * all.seek_s / all.elapsed_s : 0.0,
      all.elapsed_s > 0.0 ? 100.0 * all.near_others_s / all.elapsed_s : 0.0);
  writeFollowExperimentPage(*output / "report.html", experiment);
  writePartSummary(*output, shared, experiment.episodes.size());
  endExperiment(output);
}

}  // namespace

void addFollowExperiment(CLI::App& experiment) {
  auto options = std::make_shared<FollowExperimentOptions>();
  CLI::App* verb = experiment.add_subcommand(
      "follow", "The paper's three experiments with its plan and ours, and random homes");
  verb->footer(
      "Example:\n"
      "  heel experiment follow --out out/follow_experiment\n"
      "Every failure is listed with the command that shows it again.");
  verb->add_option("--episodes", options->params.episodes, "random homes")->capture_default_str();
  verb->add_flag_callback(
      "--no-table1", [options] { options->params.table1 = false; },
      "leave out the paper's three experiments: the random homes only");
  verb->add_option("--seed", options->params.first_seed, "of the first random home")
      ->capture_default_str();
  verb->add_option("--limit", options->params.limit_s, "a run ends after so long [s]")
      ->capture_default_str();
  addRough(*verb, options->params.rough);
  addRobotConfig(*verb, options->config);
  verb->add_option("--threads", options->params.threads,
                   "how many runs at once; 0: as many as cores")
      ->capture_default_str();
  verb->add_option("--join", options->join,
                   "make no runs: join the results of other calls, with other seeds, to one")
      ->option_text("FOLDER...");
  verb->add_option("--out", options->out, "folder for the results")->required();
  verb->callback([options] { run(*options); });
}

}  // namespace heel
