// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/tracking/assignment.hpp>
#include <heel/tracking/clear_mot.hpp>

#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

namespace heel {
namespace {

void check(const std::vector<LabelledPlace>& places) {
  std::set<int> ids;
  for (const LabelledPlace& place : places) {
    if (!place.position_m.allFinite()) {
      throw std::invalid_argument("clearMot: a place is not finite");
    }
    if (!ids.insert(place.id).second) {
      throw std::invalid_argument("clearMot: an id is there twice in a frame");
    }
  }
}

}  // namespace

ClearMot clearMot(const std::vector<TrackingFrame>& frames, const ClearMotParams& params) {
  if (!(params.match_distance_m > 0.0)) {
    throw std::invalid_argument("clearMot: the matching distance must be positive");
  }
  ClearMot sums;
  std::map<int, int> last_id;  // Of each person's estimate, by the person.
  std::map<int, int> holder;   // The person whom an id was matched to last, by the id.
  AssignmentSolver solver;
  Assignment matching;
  CostMatrix distances;
  for (const TrackingFrame& frame : frames) {
    check(frame.truth);
    check(frame.estimates);
    distances.reset(static_cast<int>(frame.truth.size()), static_cast<int>(frame.estimates.size()));
    for (int t = 0; t < distances.rows(); ++t) {
      for (int e = 0; e < distances.columns(); ++e) {
        const double distance = (frame.truth[static_cast<std::size_t>(t)].position_m -
                                 frame.estimates[static_cast<std::size_t>(e)].position_m)
                                    .norm();
        distances(t, e) = distance <= params.match_distance_m ? distance : kForbiddenPair;
      }
    }

    // A pair that goes on forbids all other pairs of its two members.
    if (params.has_identity) {
      for (int t = 0; t < distances.rows(); ++t) {
        const auto before = last_id.find(frame.truth[static_cast<std::size_t>(t)].id);
        for (int e = 0; before != last_id.end() && e < distances.columns(); ++e) {
          const bool goes_on = frame.estimates[static_cast<std::size_t>(e)].id == before->second &&
                               holder[before->second] == before->first &&
                               distances(t, e) != kForbiddenPair;
          if (!goes_on) {
            continue;
          }
          for (int other = 0; other < distances.columns(); ++other) {
            distances(t, other) = other == e ? distances(t, e) : kForbiddenPair;
          }
          for (int other = 0; other < distances.rows(); ++other) {
            distances(other, e) = other == t ? distances(t, e) : kForbiddenPair;
          }
        }
      }
    }

    solver.solveMostPairs(distances, matching);
    for (std::size_t t = 0; t < frame.truth.size(); ++t) {
      const int e = matching.column_of_row[t];
      if (e == Assignment::kNone) {
        continue;
      }
      const int id = frame.estimates[static_cast<std::size_t>(e)].id;
      const auto [last, is_new] = last_id.try_emplace(frame.truth[t].id, id);
      if (params.has_identity && !is_new && last->second != id) {
        ++sums.mismatches;
      }
      last->second = id;
      holder[id] = frame.truth[t].id;
    }
    ++sums.frames;
    sums.truths += distances.rows();
    sums.matches += matching.pairs;
    sums.misses += distances.rows() - matching.pairs;
    sums.false_positives += distances.columns() - matching.pairs;
    sums.distance_sum_m += matching.cost;
  }
  return sums;
}

}  // namespace heel
