// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/search_map.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace heel {

namespace {

constexpr double kSeenSide = 0.75;  // So much of both sides of somebody must be in sight.
constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kRounding_m = 1e-6;
constexpr double kAround_m = 0.5;   // Who is seen there may be believed to be so far off.
constexpr double kNoShare = 1e-12;  // below this a share is none
constexpr double kNoChance = 1e-6;  // below this a cell is not worth a look

void requirePositive(const SearchMapParams& p) {
  checkLimits(p.limits);
  for (const double value : {p.cell_size_m, p.body_radius_m, p.usual_speed_mps, p.straight_s,
                             p.place_sigma_m, p.field_of_view_rad, p.max_range_m, p.max_scan_m,
                             p.notice_s, p.spare_m, p.look_s, p.view_spacing_m}) {
    if (!(value > 0.0)) throw std::invalid_argument("a search map's parameters must be positive");
  }
}

double headingOf(std::size_t way) { return static_cast<double>(way) * M_PI / 4.0; }

std::size_t index(int cell) { return static_cast<std::size_t>(cell); }

}  // namespace

SearchMap::SearchMap(const OccupancyGrid& floor, const OccupancyGrid& sight,
                     const SearchMapParams& params)
    : params_((requirePositive(params), params)),
      floor_(floor, params.cell_size_m, params.body_radius_m, sight),
      shares_(index(floor_.cells()), Shares{}),
      next_(shares_),
      belief_(shares_.size(), 0.0),
      others_(shares_),
      screens_(shares_.size()),
      is_taken_(shares_.size(), false),
      reached_s_(shares_.size(), kNever),
      shut_s_(shares_.size(), kNever),
      speed_mps_(params.usual_speed_mps) {
  if (floor_.nearestFree(floor.origin_m()) < 0) {
    throw std::invalid_argument("no one can stand anywhere on this map");
  }
  findViews();
}

void SearchMap::findViews() {
  reach_cells_ = static_cast<int>(std::ceil(params_.max_range_m / params_.cell_size_m));
  const int every =
      std::max(1, static_cast<int>(std::lround(params_.view_spacing_m / params_.cell_size_m)));
  for (int c = 0; c < floor_.cells(); ++c) {
    const bool is_on_lattice =
        c % floor_.width() % every == every / 2 && c / floor_.width() % every == every / 2;
    if (is_on_lattice && floor_.isFree(c) &&
        floor_.isClear(floor_.center(c), params_.limits.radius_m + params_.spare_m)) {
      view_cells_.push_back(c);
    }
  }
  const auto edge = index(2 * reach_cells_ + 1);
  is_visible_.assign(view_cells_.size() * edge * edge, false);
  for (std::size_t view = 0; view < view_cells_.size(); ++view) {
    const Eigen::Vector2d from = floor_.center(view_cells_[view]);
    for (int c = 0; c < floor_.cells(); ++c) {
      const Eigen::Vector2d to = floor_.center(c);
      const double range = (to - from).norm();
      if (!floor_.isFree(c) || range < params_.min_range_m || range > params_.max_range_m) continue;
      is_visible_[visibleIndex(view, c)] = seesBody(from, to);
    }
  }
}

std::size_t SearchMap::visibleIndex(std::size_t view, int cell) const {
  const int from = view_cells_[view];
  const int edge = 2 * reach_cells_ + 1;
  const int x = cell % floor_.width() - from % floor_.width() + reach_cells_;
  const int y = cell / floor_.width() - from / floor_.width() + reach_cells_;
  return view * index(edge * edge) + index(y * edge + x);
}

void SearchMap::start() {
  walked_m_.assign(shares_.size(), 0.0F);
  std::fill(reached_s_.begin(), reached_s_.end(), -kNever);
  std::fill(shut_s_.begin(), shut_s_.end(), kNever);
  for (int c = 0; c < floor_.cells(); ++c) {
    shares_[index(c)].fill(floor_.isFree(c) ? 1.0 : 0.0);
  }
  speed_mps_ = params_.usual_speed_mps;
  start_ = -1;
  carried_s_ = 0.0;
  sumUp();
}

void SearchMap::start(const Eigen::Vector2d& position, const Eigen::Vector2d& velocity,
                      double ago_s, double probability) {
  if (!position.allFinite() || !velocity.allFinite()) {
    throw std::invalid_argument("a search starts at a place");
  }
  if (!(probability >= 0.0 && probability <= 1.0)) {
    throw std::invalid_argument("a probability is 0 to 1");
  }
  const int from = floor_.nearestFree(position);
  floor_.walkingDistances(from, walked_m_, open_);
  // Never before they were there, and for the place's error they may have been a little further.
  const double then_s = clock_s_ - ago_s;
  for (std::size_t c = 0; c < reached_s_.size(); ++c) {
    const double way_m = static_cast<double>(walked_m_[c]) - 2.0 * params_.place_sigma_m;
    const double reached_s = then_s + std::max(way_m, 0.0) / kFastestWalk_mps;
    reached_s_[c] = probability < 1.0 ? std::min(reached_s_[c], reached_s) : reached_s;
  }
  const double speed = velocity.norm();
  speed_mps_ +=
      probability * (std::clamp(speed, params_.usual_speed_mps, kFastestWalk_mps) - speed_mps_);
  // The faster one walked, the surer one goes on that way.
  Shares ways{};
  const double sureness = 6.0 * speed;
  const double heading = std::atan2(velocity.y(), velocity.x());
  for (std::size_t way = 0; way < kHeadings; ++way) {
    ways[way] = std::exp(sureness * (std::cos(headingOf(way) - heading) - 1.0));
  }
  shares_.swap(others_);
  std::fill(shares_.begin(), shares_.end(), Shares{});
  for (std::size_t c = 0; c < shares_.size(); ++c) {
    const double sigmas = static_cast<double>(walked_m_[c]) / params_.place_sigma_m;
    if (sigmas > 2.0) continue;
    for (std::size_t way = 0; way < kHeadings; ++way) {
      shares_[c][way] = std::exp(-0.5 * sigmas * sigmas) * ways[way];
    }
  }
  sumUp();
  clock_s_ = then_s;
  lost_s_ += probability * (then_s - lost_s_);
  if (probability > 0.5) {
    start_ = from;
    std::fill(shut_s_.begin(), shut_s_.end(), kNever);
  }
  carried_s_ = 0.0;
  spread(ago_s);
  for (std::size_t c = 0; c < shares_.size() && probability < 1.0; ++c) {
    for (std::size_t way = 0; way < kHeadings; ++way) {
      shares_[c][way] = probability * shares_[c][way] + (1.0 - probability) * others_[c][way];
    }
  }
  sumUp();
}

void SearchMap::spread(double elapsed_s, FunctionRef<bool(const Eigen::Vector2d& place)> is_taken) {
  if (!(elapsed_s >= 0.0)) throw std::invalid_argument("time does not go back");
  if (walked_m_.empty()) return;
  const double step_s = params_.cell_size_m / kFastestWalk_mps;
  carried_s_ += elapsed_s;
  if (carried_s_ < step_s) return;
  for (int c = 0; c < floor_.cells(); ++c) is_taken_[index(c)] = is_taken(floor_.center(c));
  for (; carried_s_ >= step_s; carried_s_ -= step_s) {
    clock_s_ += step_s;
    turn();
    walk();
  }
  shut();
  sumUp();
}

void SearchMap::turn() {
  const double step_s = params_.cell_size_m / kFastestWalk_mps;
  const double aside = 0.5 * (1.0 - std::exp(-step_s / params_.straight_s));
  for (Shares& cell : shares_) {
    const Shares before = cell;
    for (std::size_t way = 0; way < kHeadings; ++way) {
      cell[way] = (1.0 - 2.0 * aside) * before[way] +
                  aside * (before[(way + 1) % kHeadings] + before[(way + 7) % kHeadings]);
    }
  }
}

void SearchMap::walk() {
  std::fill(next_.begin(), next_.end(), Shares{});
  for (std::size_t c = 0; c < shares_.size(); ++c) {
    for (std::size_t way = 0; way < kHeadings; ++way) {
      const double share = shares_[c][way];
      if (share < kNoShare) continue;
      const int to = floor_.neighbour(static_cast<int>(c), static_cast<int>(way));
      if (to < 0) {  // a wall: to the left or to the right of it
        next_[c][(way + 1) % kHeadings] += 0.5 * share;
        next_[c][(way + 7) % kHeadings] += 0.5 * share;
        continue;
      }
      const double steps = way % 2 == 0 ? 1.0 : std::sqrt(0.5);
      const bool is_too_far = reached_s_[index(to)] > clock_s_;
      const bool stays = is_taken_[c] || is_taken_[index(to)];
      const bool is_barred = is_too_far || stays || isBarred(to);
      const double walks = is_barred ? 0.0 : steps * speed_mps_ / kFastestWalk_mps;
      next_[index(to)][way] += walks * share;
      next_[c][way] += (1.0 - walks) * share;
    }
  }
  shares_.swap(next_);
}

// Who is behind what bars every way to them came before it did. That is seen to stand for a time,
// and has stood as long before: of all the time since they were seen they had but the rest.
void SearchMap::shut() {
  const auto stands = [](const Screen& screen) { return screen.stands; };
  if (start_ < 0 ||
      std::none_of(screens_.begin(), screens_.end(), stands)) {  // The ways are those of the map.
    std::fill(shut_s_.begin(), shut_s_.end(), kNever);
    return;
  }
  floor_.walkingDistances(start_, open_m_, open_, [this](int cell) { return !isBarred(cell); });
  const auto since_s = [this](double stamp_s) { return stamp_s - lost_s_ + params_.look_s; };
  for (std::size_t c = 0; c < shares_.size(); ++c) {
    double& till_s = shut_s_[c];
    if (std::isfinite(open_m_[c])) {
      till_s = kNever;
      continue;
    }
    const double had_s = till_s == kNever ? clock_s_ - lost_s_ : since_s(till_s);
    for (double& share : shares_[c]) share *= had_s / since_s(clock_s_);
    till_s = clock_s_;
  }
}

bool SearchMap::isBarred(int cell, double in_s) const {
  return passes(screens_[index(cell)], in_s) <= 0.5;
}

// What a look goes through does not stand there any more. Where it is not known how far a look
// goes, it goes as far as those before.
void SearchMap::look(const FloorPose& camera, double elapsed_s,
                     FunctionRef<std::optional<SeenTo>(const Eigen::Vector2d&)> seenTo) {
  seen_.clear();
  thin(elapsed_s, [&](int cell) {
    const Eigen::Vector2d place = floor_.center(cell);
    if (!isInView(camera, place)) return false;
    const std::optional<SeenTo> seen = seenTo(place);
    if (!seen) return passes(camera.position, place, 0.0) > 0.5;
    const bool is_seen = (seen->place - place).norm() < kRounding_m;
    if (is_seen && seen->by_somebody) return false;  // It may be they.
    if (is_seen) {
      seen_.push_back(cell);
    } else if (const int at = floor_.cellAt(seen->place); at >= 0) {
      Screen& screen = screens_[index(at)];
      const double came_s = seen->by_somebody ? clock_s_ : 0.5 * (screen.free_s + clock_s_);
      if (!screen.stands) screen.since_s = came_s;
      screen.stands = true;
      screen.last_s = clock_s_;
    }
    return is_seen;
  });
  for (const int cell : seen_) {
    forCellsBetween(camera.position, floor_.center(cell), [&](int between) {
      Screen& screen = screens_[index(between)];
      if (screen.stands && screen.last_s == clock_s_) return;
      screen.stands = false;
      screen.free_s = clock_s_;
    });
  }
}

// What has stood for a time stays for that time: by then it has gone by the half.
double SearchMap::passes(const Screen& screen, double in_s) const {
  if (!screen.stands) return 1.0;
  const double since_s = clock_s_ - screen.last_s + in_s;
  return since_s / (since_s + screen.last_s - screen.since_s + params_.look_s);
}

// What is in the way is one thing, in however many cells.
double SearchMap::passes(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                         double in_s) const {
  double least = 1.0;
  forCellsBetween(from, to, [&](int between) {
    least = std::min(least, passes(screens_[index(between)], in_s));
  });
  return least;
}

template <typename Use>
void SearchMap::forCellsBetween(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                                Use use) const {
  const int steps = static_cast<int>(std::ceil((to - from).norm() / (0.5 * floor_.cellSize_m())));
  int last = -1;
  for (int i = 0; i <= steps; ++i) {
    const int cell =
        floor_.cellAt(from + static_cast<double>(i) / std::max(steps, 1) * (to - from));
    if (cell >= 0 && cell != last) use(cell);
    last = cell;
  }
}

void SearchMap::hold(const Eigen::Vector2d& place, double radius_m, double probability) {
  if (!(probability >= 0.0 && probability <= 1.0)) {
    throw std::invalid_argument("a probability is 0 to 1");
  }
  const auto isThere = [&](std::size_t c) {
    return (floor_.center(static_cast<int>(c)) - place).norm() < radius_m;
  };
  double there = 0.0, elsewhere = 0.0;
  for (std::size_t c = 0; c < belief_.size(); ++c) (isThere(c) ? there : elsewhere) += belief_[c];
  if (!(there > kNoShare && elsewhere > kNoShare)) return;
  for (std::size_t c = 0; c < belief_.size(); ++c) {
    const double gain = isThere(c) ? probability / there : (1.0 - probability) / elsewhere;
    for (double& share : shares_[c]) share *= gain;
  }
  sumUp();
}

void SearchMap::scan(const LaserScan& scan, const FloorPose& scanner, double elapsed_s) {
  thin(elapsed_s, [&](int cell) { return isSeenThrough(scan, scanner, floor_.center(cell)); });
}

void SearchMap::thin(double elapsed_s, FunctionRef<bool(int cell)> is_empty) {
  if (!(elapsed_s >= 0.0)) throw std::invalid_argument("time does not go back");
  if (walked_m_.empty()) return;
  const double unnoticed = std::max(1e-6, std::exp(-elapsed_s / params_.notice_s));
  for (std::size_t c = 0; c < shares_.size(); ++c) {
    if (belief_[c] < kNoShare || !is_empty(static_cast<int>(c))) continue;
    for (double& share : shares_[c]) share *= unnoticed;
  }
  sumUp();
}

// Every beam that would meet somebody who stands there goes on behind them.
bool SearchMap::isSeenThrough(const LaserScan& scan, const FloorPose& scanner,
                              const Eigen::Vector2d& point) const {
  const Eigen::Vector2d to = scanner.inverse() * point;
  const double range = to.norm();
  if (range <= params_.body_radius_m || range > params_.max_scan_m) return false;
  const double half = std::asin(params_.body_radius_m / range) / std::abs(scan.step_rad);
  const double middle = scan.beamAt(std::atan2(to.y(), to.x()));
  const auto behind = static_cast<float>(range + params_.body_radius_m);
  const double last = std::floor(middle + half);
  double beam = std::ceil(middle - half);
  if (!(last >= beam)) return false;  // Not where it is not a number.
  for (; beam <= last; ++beam) {
    const std::size_t i = scan.index(beam);
    if (i >= scan.ranges_m.size() || !(scan.ranges_m[i] > behind)) return false;
  }
  return true;
}

bool SearchMap::isInView(const FloorPose& camera, const Eigen::Vector2d& point) const {
  const Eigen::Vector2d ray = point - camera.position;
  const double range = ray.norm();
  if (range < params_.min_range_m || range > params_.max_range_m) return false;
  const double bearing = wrapped(std::atan2(ray.y(), ray.x()) - camera.yaw_rad);
  return std::abs(bearing) <= 0.5 * params_.field_of_view_rad && seesBody(camera.position, point);
}

// Who is hidden by half is seen, and not recognized.
bool SearchMap::seesBody(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  const Eigen::Vector2d ray = (to - from).normalized();
  const Eigen::Vector2d side =
      kSeenSide * params_.body_radius_m * Eigen::Vector2d(-ray.y(), ray.x());
  return floor_.sees(from, to + side) && floor_.sees(from, to - side);
}

void SearchMap::sumUp() {
  double total = 0.0;
  for (std::size_t c = 0; c < shares_.size(); ++c) {
    belief_[c] = std::accumulate(shares_[c].begin(), shares_[c].end(), 0.0);
    total += belief_[c];
  }
  for (std::size_t c = 0; c < shares_.size(); ++c) {
    if (belief_[c] == 0.0) continue;
    belief_[c] /= total;
    for (double& share : shares_[c]) share /= total;
  }
}

double SearchMap::density(const Eigen::Vector2d& place) const {
  const int reach = static_cast<int>(kAround_m / params_.cell_size_m);
  double chance = 0.0, area_m2 = 0.0;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      const Eigen::Vector2d off = params_.cell_size_m * Eigen::Vector2d(x, y);
      const int cell = floor_.cellAt(place + off);
      if (cell < 0 || off.norm() > kAround_m || !floor_.isFree(cell)) continue;
      chance += belief_[index(cell)];
      area_m2 += params_.cell_size_m * params_.cell_size_m;
    }
  }
  return area_m2 > 0.0 ? chance / area_m2 : 0.0;
}

std::optional<SearchView> SearchMap::nextView(const FloorPose& camera,
                                              FunctionRef<double(const Eigen::Vector2d&)> way_s) {
  if (walked_m_.empty()) return std::nullopt;
  // First the place, by all that is in view around it: who goes to a room looks all around in it.
  const double around_s = 2.0 * M_PI / params_.limits.max_turn_radps + params_.look_s;
  const auto toThere_s = [&](double on_way_m) { return on_way_m / params_.limits.max_speed_mps; };
  const auto onMap_s = [&](std::size_t view) {
    return toThere_s(static_cast<double>(way_m_[index(view_cells_[view])]));
  };
  const auto rateViews = [&](FunctionRef<bool(int cell)> is_open) {
    floor_.walkingDistances(floor_.nearestFree(camera.position), way_m_, way_open_, is_open);
    chances_.assign(view_cells_.size(), 0.0);
    rates_.assign(view_cells_.size(), 0.0);
    by_rate_.clear();
    for (std::size_t view = 0; view < view_cells_.size(); ++view) {
      if (!std::isfinite(onMap_s(view))) continue;
      const Bearings around = chancesAround(view, onMap_s(view) + params_.look_s);
      chances_[view] = std::accumulate(around.begin(), around.end(), 0.0);
      rates_[view] = chances_[view] / (onMap_s(view) + around_s);
      if (rates_[view] > 0.0) by_rate_.push_back(view);
    }
  };
  // What bars a way may be gone by the time when it is there; where it is likely not to be, that
  // comes last.
  rateViews([&](int cell) {
    return !isBarred(cell, toThere_s((floor_.center(cell) - camera.position).norm()));
  });
  if (by_rate_.empty()) rateViews([](int) { return true; });
  if (by_rate_.empty()) return std::nullopt;
  std::sort(by_rate_.begin(), by_rate_.end(), [this](std::size_t a, std::size_t b) {
    return rates_[a] != rates_[b] ? rates_[a] > rates_[b] : a < b;
  });
  std::size_t best = by_rate_.front();
  double best_s = onMap_s(best), best_rate = 0.0;
  for (const std::size_t view : by_rate_) {
    if (rates_[view] <= best_rate) break;  // A way is never shorter than on the map.
    const double there_s = std::max(way_s(floor_.center(view_cells_[view])), onMap_s(view));
    const double rate = chances_[view] / (there_s + around_s);
    if (!(rate > best_rate)) continue;
    best = view;
    best_s = there_s;
    best_rate = rate;
  }
  return bestLook(best, best_s, camera.yaw_rad);
}

SearchMap::Bearings SearchMap::chancesAround(std::size_t view, double in_s) const {
  Bearings chances{};
  const int cell = view_cells_[view];
  const int x0 = cell % floor_.width(), y0 = cell / floor_.width();
  const Eigen::Vector2d from = floor_.center(cell);
  const int high_x = std::min(floor_.width() - 1, x0 + reach_cells_);
  const int high_y = std::min(floor_.height() - 1, y0 + reach_cells_);
  for (int y = std::max(0, y0 - reach_cells_); y <= high_y; ++y) {
    for (int x = std::max(0, x0 - reach_cells_); x <= high_x; ++x) {
      const int c = y * floor_.width() + x;
      if (belief_[index(c)] < kNoChance || !is_visible_[visibleIndex(view, c)]) continue;
      const double turns = std::atan2(y - y0, x - x0) / (2.0 * M_PI) + 1.0;
      chances[static_cast<std::size_t>(turns * kBearings) % kBearings] +=
          passes(from, floor_.center(c), in_s) * belief_[index(c)];
    }
  }
  return chances;
}

SearchView SearchMap::bestLook(std::size_t view, double way_s, double yaw_rad) const {
  const Bearings around = chancesAround(view, way_s + params_.look_s);
  const auto in_view = static_cast<std::size_t>(
      std::clamp(params_.field_of_view_rad / (2.0 * M_PI) * kBearings, 1.0, 1.0 * kBearings));
  SearchView best;
  double best_rate = -1.0;
  for (std::size_t first = 0; first < kBearings; ++first) {
    double chance = 0.0;
    for (std::size_t i = 0; i < in_view; ++i) chance += around[(first + i) % kBearings];
    const double middle = static_cast<double>(first) + 0.5 * static_cast<double>(in_view);
    const double yaw = wrapped(2.0 * M_PI / kBearings * middle);
    const double look_s =
        std::abs(wrapped(yaw - yaw_rad)) / params_.limits.max_turn_radps + params_.look_s;
    if (!(chance / look_s > best_rate)) continue;
    best_rate = chance / look_s;
    best = {{floor_.center(view_cells_[view]), yaw}, chance, way_s + look_s};
  }
  return best;
}

}  // namespace heel
