// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/param_checks.hpp>
#include <heel/apps/follower/person_search.hpp>

namespace heel {

PersonSearch::PersonSearch(const OccupancyGrid& floor, const OccupancyGrid& sight,
                           const PersonSearchParams& params)
    : params_(params), map_(floor, sight, params.map) {
  requireNotNegative("PersonSearchParams", {params.budget_s, params.new_view_s});
}

void PersonSearch::lose(const MovingPerson& last, double unseen_s, double probability) {
  map_.start(last.position, last.velocity, unseen_s, probability);
  view_.reset();
  searched_s_ = 0.0;
  is_over_ = false;
}

bool PersonSearch::choose(double elapsed_s, const FloorPose& robot, bool is_there,
                          FunctionRef<double(const Eigen::Vector2d&)> way_s) {
  searched_s_ += elapsed_s;
  view_age_s_ += elapsed_s;
  if (view_ && !is_there && view_age_s_ <= params_.new_view_s) return false;
  const std::optional<SearchView> before = view_;
  view_ = map_.nextView(robot, way_s);
  view_age_s_ = 0.0;
  is_over_ = !view_;
  return !before || !view_ || view_->camera.position != before->camera.position;
}

}  // namespace heel
