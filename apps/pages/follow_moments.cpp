// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/pages/follow_map.hpp>
#include <heel/apps/pages/html.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace heel {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value, double unit = 100.0) {
  return std::isfinite(value) ? Json(std::round(value * unit) / unit) : Json(nullptr);
}

Json place(const std::optional<Eigen::Vector2d>& at, const MapFrame& frame) {
  if (!at || !at->allFinite()) return nullptr;
  const Eigen::Vector2d drawn = frame(*at);
  return Json::array({number(drawn.x()), number(drawn.y())});
}

/// Texts that come again and again, by number.
class Texts {
 public:
  std::size_t of(const std::string& text) {
    const auto [at, is_new] = numbers_.emplace(text, texts_.size());
    if (is_new) texts_.push_back(text);
    return at->second;
  }
  const std::vector<std::string>& all() const { return texts_; }

 private:
  std::map<std::string, std::size_t> numbers_;
  std::vector<std::string> texts_;
};

}  // namespace

FollowMoments followMoments(const FollowLog& log, const MapFrame& frame, StateTones& tones,
                            std::size_t most) {
  const std::size_t total = log.samples.size();
  const std::size_t stride =
      std::max<std::size_t>(1, (total + most - 1) / std::max<std::size_t>(1, most));
  std::vector<const FollowSample*> chosen;
  for (std::size_t i = 0; i < total; i += stride) chosen.push_back(&log.samples[i]);
  if (total > 0 && chosen.back() != &log.samples.back()) chosen.push_back(&log.samples.back());

  std::size_t most_others = 0;
  for (const FollowSample& sample : log.samples) {
    most_others = std::max(most_others, sample.others_true.size());
  }

  Json json;
  const char* const kColumns[] = {"t",     "state", "reason", "distance", "speed",   "clearance",
                                  "error", "robot", "yaw",    "person",   "estimate"};
  for (const char* column : kColumns) json[column] = Json::array();
  json["others"] = Json(std::vector<Json>(most_others, Json::array()));
  Texts states, reasons;
  std::size_t start = 0;
  for (const FollowSample* s : chosen) {
    if (s->state == "learn") start = json["t"].size();
    json["t"].push_back(number(s->stamp_s, 1000.0));
    json["state"].push_back(states.of(s->state));
    json["reason"].push_back(reasons.of(s->reason));
    json["distance"].push_back(number(s->person_distance_m));
    json["speed"].push_back(number(s->speed_true.forward_mps));
    json["clearance"].push_back(number(s->clearance_m));
    json["error"].push_back(number((s->robot_estimated.position - s->robot_true.position).norm()));
    json["robot"].push_back(place(s->robot_true.position, frame));
    json["yaw"].push_back(number(s->robot_true.yaw_rad * 180.0 / M_PI, 10.0));
    json["person"].push_back(place(s->person_true, frame));
    json["estimate"].push_back(place(s->target_estimate, frame));
    for (std::size_t i = 0; i < most_others; ++i) {
      json["others"][i].push_back(i < s->others_true.size() ? place(s->others_true[i], frame)
                                                            : Json(nullptr));
    }
  }
  json["states"] = Json::array();
  for (const std::string& state : states.all()) {
    json["states"].push_back({{"name", wordsOf(state)}, {"tone", tones.of(state)}});
  }
  json["reasons"] = reasons.all();
  json["start"] = start;
  return {chosen.size(), scriptJson(json)};
}

}  // namespace heel
