// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/follow_experiment.hpp>
#include <heel/apps/heel/experiment/experiment_commands.hpp>
#include <heel/apps/heel/shared/arguments.hpp>
#include <heel/apps/heel/shared/terminal.hpp>
#include <heel/apps/output/run_end.hpp>
#include <heel/apps/results/result_files.hpp>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace heel {
namespace {

struct FollowExperimentOptions {
  std::filesystem::path out;
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

void run(FollowExperimentOptions& options) {
  options.params.scenes = sceneFolder();
  options.params.plans = planFolder();
  if (!options.config.empty()) {
    options.params.config = loadRobotConfig(robotFile(options.config).string());
  }
  std::optional<Output> output = experimentOutput("follow", options.out);
  const int runs = (options.params.table1 ? 6 : 0) + options.params.episodes;
  ProgressBar progress("runs", static_cast<std::size_t>(runs));
  std::size_t count = 0;
  FollowExperiment experiment =
      runFollowExperiment(options.params, [&](const FollowEpisode& episode) {
        printRow(episode);
        progress.show(++count);
      });
  experiment.command = "heel experiment follow --episodes " +
                       std::to_string(options.params.episodes) + " --seed " +
                       std::to_string(options.params.first_seed);
  if (!options.params.table1) experiment.command += " --no-table1";
  if (!options.params.rough.empty()) experiment.command += " --rough " + options.params.rough;
  const std::string config = options.config.empty() ? "" : " --config " + options.config;
  experiment.command += config + " --out again";
  for (FollowEpisode& episode : experiment.episodes) episode.command += config + " --out again";
  const EpisodeCounts all = countEpisodes(experiment.episodes, experiment.plans.back());
  std::printf(
      "%d random episodes: %d reached, %d with a contact by the robot, wrong person %.2f %% of the "
      "time, "
      "seeking %.0f %%\n",
      all.episodes, all.reached, all.with_contact, 100.0 * all.wrongShare(),
      all.elapsed_s > 0.0 ? 100.0 * all.seek_s / all.elapsed_s : 0.0);
  if (isStopRequested()) experiment.title += " (incomplete: it was stopped)";
  writeEpisodesCsv(*output / "episodes.csv", experiment);
  writeFollowExperimentPage(*output / "report.html", experiment);
  writeJson(*output / "summary.json",
            {{"complete", !isStopRequested()}, {"episodes", experiment.episodes.size()}});
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
  verb->add_option("--jobs", options->params.jobs, "runs side by side; 0: one for each thread")
      ->capture_default_str();
  verb->add_option("--out", options->out, "folder for the results")->required();
  verb->callback([options] { run(*options); });
}

}  // namespace heel
