// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/output/csv_file.hpp>
#include <heel/apps/results/follow_episodes.hpp>

namespace heel {
namespace {

using Episodes = std::vector<FollowEpisode>;

constexpr const char* kTable1 = "table1";
constexpr const char* kRandom = "random";

const std::vector<std::string>& episodeColumns() {
  static const std::vector<std::string> columns = {"group",
                                                   "name",
                                                   "seed",
                                                   "plan",
                                                   "outcome",
                                                   "distance_m",
                                                   "elapsed_s",
                                                   "seek_s",
                                                   "moving_speed_mps",
                                                   "contacts_by_robot",
                                                   "contacts_by_people",
                                                   "wrong_person_s",
                                                   "near_others_s",
                                                   "min_clearance_m",
                                                   "losses",
                                                   "position_rms_m",
                                                   "yaw_rms_rad",
                                                   "cause",
                                                   "command"};
  return columns;
}

void addRows(CsvWriter& csv, const std::string& group, const Episodes& episodes) {
  for (const FollowEpisode& e : episodes) {
    const FollowSummary& s = e.summary;
    csv.text(group).text(e.name).integer(static_cast<std::int64_t>(e.seed)).text(e.plan);
    csv.text(s.outcome).number(s.distance_m, 3).number(s.elapsed_s, 3).number(s.seek_s, 3);
    csv.number(s.moving_speed_mps, 4).integer(s.contacts_by_robot);
    csv.integer(s.contactsByPeople()).number(s.wrong_person_s, 3);
    csv.number(s.near_others_s, 3);
    csv.number(s.min_clearance_m, 3).integer(s.losses).number(s.position_rms_m, 4);
    csv.number(s.yaw_rms_rad, 5).text(e.cause).text(e.command).endRow();
  }
}

}  // namespace

bool isFailure(const FollowEpisode& episode) {
  const FollowSummary& s = episode.summary;
  return s.outcome != "reached" || s.contacts_by_robot > 0 || s.wrongShare() >= kWrongShareLimit;
}

EpisodeCounts countEpisodes(const Episodes& episodes, const std::string& plan) {
  EpisodeCounts counts;
  for (const FollowEpisode& e : episodes) {
    if (e.plan != plan) continue;
    ++counts.episodes;
    counts.reached += e.summary.outcome == "reached" ? 1 : 0;
    counts.with_contact += e.summary.contacts_by_robot > 0 ? 1 : 0;
    counts.contacts_by_robot += e.summary.contacts_by_robot;
    counts.contacts_by_people += e.summary.contactsByPeople();
    counts.elapsed_s += e.summary.elapsed_s;
    counts.seek_s += e.summary.seek_s;
    counts.wrong_person_s += e.summary.wrong_person_s;
    counts.near_others_s += e.summary.near_others_s;
    counts.distance_m += e.summary.distance_m;
  }
  return counts;
}

void writeEpisodesCsv(const OutputPath& file, const FollowExperiment& experiment) {
  CsvWriter csv(file, episodeColumns());
  addRows(csv, kTable1, experiment.table1);
  addRows(csv, kRandom, experiment.episodes);
  csv.close();
}

void readEpisodesCsv(const std::filesystem::path& file, FollowExperiment& experiment) {
  CsvReader csv(file, episodeColumns());
  const auto numberOrUnknown = [&csv](std::size_t i) {
    return csv.text(i).empty() ? kNotKnown : csv.number(i);
  };
  while (csv.next()) {
    FollowEpisode& e =
        (csv.text(0) == kTable1 ? experiment.table1 : experiment.episodes).emplace_back();
    e.name = csv.text(1);
    e.seed = static_cast<unsigned long>(csv.integer(2));
    e.plan = csv.text(3);
    FollowSummary& s = e.summary;
    s.outcome = csv.text(4);
    s.distance_m = csv.number(5);
    s.elapsed_s = csv.number(6);
    s.seek_s = csv.number(7);
    s.moving_speed_mps = numberOrUnknown(8);
    s.contacts_by_robot = static_cast<int>(csv.integer(9));
    s.contacts = s.contacts_by_robot + static_cast<int>(csv.integer(10));
    s.wrong_person_s = csv.number(11);
    s.near_others_s = csv.number(12);
    s.min_clearance_m = numberOrUnknown(13);
    s.losses = static_cast<int>(csv.integer(14));
    s.position_rms_m = numberOrUnknown(15);
    s.yaw_rms_rad = numberOrUnknown(16);
    e.cause = csv.text(17);
    e.command = csv.text(18);
  }
}

}  // namespace heel
