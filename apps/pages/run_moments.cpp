// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/pages/html.hpp>
#include <heel/apps/pages/run_moments.hpp>

#include <algorithm>
#include <cmath>

namespace heel {
namespace {

using Json = nlohmann::ordered_json;

Json rounded(double value, double steps = 100.0) {
  return std::isfinite(value) ? Json(std::round(value * steps) / steps) : Json(nullptr);
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

RunMoments::RunMoments(const std::vector<double>& stamps_s, std::size_t most) {
  const std::size_t total = stamps_s.size();
  const std::size_t stride =
      std::max<std::size_t>(1, (total + most - 1) / std::max<std::size_t>(1, most));
  for (std::size_t i = 0; i < total; i += stride) chosen_.push_back(i);
  if (total > 0 && chosen_.back() != total - 1) chosen_.push_back(total - 1);
  json_["t"] = Json::array();
  for (const std::size_t i : chosen_) {
    stamps_s_.push_back(stamps_s[i]);
    json_["t"].push_back(rounded(stamps_s[i], 1000.0));
  }
  if (total > 0) {
    first_s_ = stamps_s.front();
    if (stamps_s.back() > first_s_) duration_s_ = stamps_s.back() - first_s_;
  }
  json_["start"] = 0;
  json_["columns"] = json_["marks"] = Json::object();
  json_["state"] = json_["states"] = json_["reason"] = json_["reasons"] = Json::array();
  json_["lost"] = Json::array();
  json_["film"] = nullptr;
}

void RunMoments::addColumn(const std::string& name, const Number& value, double steps) {
  Json& column = json_["columns"][name] = Json::array();
  for (const std::size_t i : chosen_) column.push_back(rounded(value(i), steps));
}

void RunMoments::addMark(const std::string& id, const Place& place, const Number& turn_rad,
                         const Text& label) {
  Json& mark = json_["marks"][id];
  mark["at"] = Json::array();
  for (const std::size_t i : chosen_) {
    const std::optional<Eigen::Vector2d> at = place(i);
    mark["at"].push_back(at && at->allFinite() ? Json::array({rounded(at->x()), rounded(at->y())})
                                               : Json(nullptr));
    if (turn_rad) mark["turn"].push_back(rounded(-turn_rad(i) * 180.0 / M_PI, 10.0));
    if (label) mark["label"].push_back(label(i));
  }
}

void RunMoments::addState(const Text& state, const Text& reason, StateTones& tones) {
  Texts states, reasons;
  for (const std::size_t i : chosen_) {
    json_["state"].push_back(states.of(state(i)));
    json_["reason"].push_back(reasons.of(reason(i)));
  }
  for (const std::string& name : states.all()) {
    json_["states"].push_back({{"name", wordsOf(name)}, {"tone", tones.of(name)}});
  }
  json_["reasons"] = reasons.all();
}

std::size_t RunMoments::momentAt(double stamp_s) const {
  const auto after = std::upper_bound(stamps_s_.begin(), stamps_s_.end(), stamp_s);
  return after == stamps_s_.begin() ? 0 : static_cast<std::size_t>(after - stamps_s_.begin()) - 1;
}

void RunMoments::startAt(double stamp_s) { json_["start"] = momentAt(stamp_s); }

void RunMoments::addLoss(double from_s, double to_s) {
  json_["lost"].push_back({rounded(from_s, 1000.0), rounded(to_s, 1000.0)});
}

void RunMoments::addFilm(double rate_hz, const std::vector<double>& stamps_s) {
  Json pictures = Json::array();
  for (const double stamp_s : stamps_s_) {
    const auto after = std::upper_bound(stamps_s.begin(), stamps_s.end(), stamp_s + 1e-6);
    pictures.push_back(after - stamps_s.begin() - 1);  // -1: the film has not begun
  }
  json_["film"] = {{"rate", rate_hz}, {"picture", pictures}};
}

std::string RunMoments::json(const Json& charts) {
  json_["charts"] = charts;
  return scriptJson(json_);
}

}  // namespace heel
