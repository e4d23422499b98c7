// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/follow_experiment.hpp>
#include <heel/apps/experiment/random_home.hpp>
#include <heel/apps/output/run_end.hpp>
#include <heel/planning/plan_file.hpp>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

namespace heel {
namespace {

/// One run to be made.
struct Job {
  FollowEpisode episode;
  bool is_random = false;
  bool has_ended = false;
};

std::vector<Job> jobsOf(const FollowExperimentParams& params,
                        const std::vector<std::string>& plans) {
  std::vector<Job> jobs;
  for (int number = 1; params.table1 && number <= 3; ++number) {
    for (const std::string& plan : plans) {
      Job& job = jobs.emplace_back();
      job.episode.name = "Experiment " + std::to_string(number);
      job.episode.seed = static_cast<unsigned long>(number);
      job.episode.plan = plan;
      job.episode.command = std::string("heel follow office") + (number == 1 ? " --alone" : "") +
                            " --plan " + plan + " --seed " + std::to_string(number);
    }
  }
  for (int i = 0; i < params.episodes; ++i) {
    Job& job = jobs.emplace_back();
    job.is_random = true;
    job.episode.seed = params.first_seed + static_cast<std::uint64_t>(i);
    job.episode.name = "Episode " + std::to_string(job.episode.seed);
    job.episode.plan = plans.back();
    job.episode.command = "heel follow --random --seed " + std::to_string(job.episode.seed);
  }
  return jobs;
}

void run(Job& job, const FollowExperimentParams& params) {
  FollowEpisode& episode = job.episode;
  Scene scene = job.is_random ? randomEpisode(episode.seed, params.scenes)
                              : loadScene((params.scenes / "office.yaml").string());
  if (!job.is_random && episode.seed == 1) scene.people.resize(1);
  const PetriPlan plan = loadPlan(params.plans / (episode.plan + ".pnml"), followingVocabulary());
  ClosedLoopParams loop;
  if (params.config) {
    putRobot(scene, params.config->robot);
    loop.follower = params.config->follow;
  }
  loop.seed = episode.seed;
  loop.threads = 1;  // Whole runs are what goes on side by side.
  loop.limit_s = params.limit_s;
  if (job.is_random) loop.rough = roughWorldOf(params.rough);
  const FollowLog log = runClosedLoop(scene, plan, loop);
  episode.summary = summarize(log);
  episode.cause = causeOfFailure(log, episode.summary);
}

std::string atTime(const char* what, double stamp_s) {
  char text[96];
  std::snprintf(text, sizeof text, "%s at %.1f s", what, stamp_s);
  return text;
}

}  // namespace

std::string causeOfFailure(const FollowLog& log, const FollowSummary& summary) {
  const auto contact = std::find_if(log.samples.begin(), log.samples.end(),
                                    [](const FollowSample& s) { return s.contact_by_robot; });
  if (contact != log.samples.end()) {
    return atTime(("contact while '" + contact->state + "'").c_str(), contact->stamp_s);
  }
  if (summary.outcome != "reached") {
    const FollowSample& last = log.samples.back();
    return summary.outcome + " while '" + last.state + "'" +
           (last.reason.empty() ? "" : ": " + last.reason);
  }
  return summary.wrongShare() >= 0.01 ? "somebody else was followed for a while" : "";
}

const std::vector<std::string>& experimentPlans() {
  static const std::vector<std::string> plans = {"paper", "search"};
  return plans;
}

FollowExperiment runFollowExperiment(const FollowExperimentParams& params,
                                     const std::function<void(const FollowEpisode&)>& done) {
  roughWorldOf(params.rough);  // or it is told now what is wrong with it
  FollowExperiment experiment;
  experiment.plans = experimentPlans();
  std::vector<Job> jobs = jobsOf(params, experiment.plans);
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr error;
  const auto work = [&] {
    for (std::size_t i = next++; i < jobs.size() && !isStopRequested(); i = next++) {
      try {
        run(jobs[i], params);
      } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex);
        if (!error) error = std::current_exception();
        next = jobs.size();
        return;
      }
      const std::lock_guard<std::mutex> lock(mutex);
      jobs[i].has_ended = jobs[i].episode.summary.outcome != kStoppedRun;
      if (done && jobs[i].has_ended) done(jobs[i].episode);
    }
  };
  const unsigned count = params.threads > 0 ? static_cast<unsigned>(params.threads)
                                            : std::max(1U, std::thread::hardware_concurrency());
  std::vector<std::thread> threads;
  for (unsigned i = 0; i < count; ++i) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  if (error) std::rethrow_exception(error);
  for (Job& job : jobs) {
    if (!job.has_ended) continue;
    auto& list = job.is_random ? experiment.episodes : experiment.table1;
    list.push_back(std::move(job.episode));
  }
  return experiment;
}

}  // namespace heel
