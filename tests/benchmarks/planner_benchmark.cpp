// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Our planner beside OMPL's RRT-Connect and RRT* (1 s) on the same maps, starts and goals; OMPL
/// asks the same clearance map whether a motion is clear. Times are of this thread's processor,
/// each a median of several runs. Not counted on either side is what is done once with a map: for
/// OMPL the clearance map, for us also the look at all moves of the quick search ("prepare" is
/// both). Usage: planner_benchmark [MAP.pgm CELL_SIZE_M]...; without maps, drawn ones.

#include "tests/planning/drawn_map.hpp"
#include <heel/planning/global_planner.hpp>

#include <ompl/base/MotionValidator.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/util/Console.h>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace heel {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

constexpr int kQueries = 24, kRepeats = 5;
constexpr double kBody_m = 0.31;

double nowMs() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

Eigen::Vector2d pointOf(const ob::State* state) {
  const double* v = state->as<ob::RealVectorStateSpace::StateType>()->values;
  return {v[0], v[1]};
}

/// Asks our map about a whole motion at once, which is to OMPL's advantage.
class SweptMotion : public ob::MotionValidator {
 public:
  SweptMotion(const ob::SpaceInformationPtr& space, const ClearanceMap& map)
      : ob::MotionValidator(space), map_(map) {}
  bool checkMotion(const ob::State* a, const ob::State* b) const override {
    return map_.isClear(pointOf(a), pointOf(b), kBody_m);
  }
  bool checkMotion(const ob::State* a, const ob::State* b,
                   std::pair<ob::State*, double>& last) const override {
    if (checkMotion(a, b)) return true;
    if (last.first != nullptr) si_->copyState(last.first, a);
    last.second = 0.0;
    return false;
  }

 private:
  const ClearanceMap& map_;
};

struct Answer {
  double ms = 0.0, length_m = 0.0;
};

template <typename Planner>
Answer planByOmpl(const ClearanceMap& map, const OccupancyGrid& grid, const Eigen::Vector2d& start,
                  const Eigen::Vector2d& goal, double seconds) {
  auto space = std::make_shared<ob::RealVectorStateSpace>(2);
  ob::RealVectorBounds bounds(2);
  for (unsigned k = 0; k < 2; ++k) {
    const int cells = k == 0 ? grid.width() : grid.height();
    bounds.setLow(k, grid.origin_m()[k]);
    bounds.setHigh(k, grid.origin_m()[k] + cells * grid.cell_size_m());
  }
  space->setBounds(bounds);
  og::SimpleSetup setup(space);
  const auto& information = setup.getSpaceInformation();
  setup.setStateValidityChecker(
      [&](const ob::State* state) { return map.isClear(pointOf(state), pointOf(state), kBody_m); });
  information->setMotionValidator(std::make_shared<SweptMotion>(information, map));
  ob::ScopedState<> from(space), to(space);
  for (unsigned k = 0; k < 2; ++k) {
    from[k] = start[k];
    to[k] = goal[k];
  }
  setup.setStartAndGoalStates(from, to);
  setup.setOptimizationObjective(
      std::make_shared<ob::PathLengthOptimizationObjective>(information));
  setup.setPlanner(std::make_shared<Planner>(information));
  setup.setup();
  const double begin = nowMs();
  const auto status = setup.solve(seconds);
  Answer answer{nowMs() - begin, 0.0};
  if (status == ob::PlannerStatus::EXACT_SOLUTION)
    answer.length_m = setup.getSolutionPath().length();
  return answer;
}

OccupancyGrid readPgm(const std::string& file, double cell_size_m) {
  const cv::Mat image = cv::imread(file, cv::IMREAD_GRAYSCALE);
  if (image.empty()) {
    std::fprintf(stderr, "%s: not an image\n", file.c_str());
    std::exit(1);
  }
  OccupancyGrid grid({0, 0}, cell_size_m, image.cols, image.rows);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const int value = image.at<unsigned char>(image.rows - 1 - y, x);
      grid.at(GridCell{x, y}) = value > 250   ? Occupancy::kFree
                                : value > 100 ? Occupancy::kUnknown
                                              : Occupancy::kOccupied;
    }
  }
  return grid;
}

double middleOf(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

void compare(const std::string& name, const OccupancyGrid& grid) {
  std::mt19937 random(1);
  double begin = nowMs();
  GlobalPlanner planner(grid, {});
  const double prepare_ms = nowMs() - begin;
  const ClearanceMap& map = planner.clearance();
  const Eigen::Vector2d low = grid.origin_m();
  const Eigen::Vector2d size = grid.cell_size_m() * Eigen::Vector2d(grid.width(), grid.height());
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto place = [&] {
    while (true) {
      const Eigen::Vector2d p =
          low + size.cwiseProduct(Eigen::Vector2d(unit(random), unit(random)));
      if (map.isClear(p, p, kBody_m)) return p;
    }
  };
  std::vector<double> first, again, connect, connect_ratio, star_ratio;
  GlobalPlan plan;
  for (int tries = 0; static_cast<int>(first.size()) < kQueries && tries < 500; ++tries) {
    const Eigen::Vector2d start = place();
    Eigen::Vector2d goal = place();
    if (map.isClear(start, goal, kBody_m)) continue;
    std::vector<double> ours_ms, quick_ms;
    for (int k = 0; k < kRepeats; ++k) {
      planner.forget();
      begin = nowMs();
      planner.plan(start, goal, plan);
      ours_ms.push_back(nowMs() - begin);
    }
    if (plan.status != PlanStatus::kFound) continue;
    first.push_back(middleOf(ours_ms));
    const double ours_m = plan.length_m;
    Answer quick;
    for (int k = 0; k < kRepeats; ++k) {
      quick = planByOmpl<og::RRTConnect>(map, grid, start, goal, 10.0);
      quick_ms.push_back(quick.ms);
    }
    const Answer best = planByOmpl<og::RRTstar>(map, grid, start, goal, 1.0);
    connect.push_back(middleOf(quick_ms));
    if (quick.length_m > 0.0) connect_ratio.push_back(ours_m / quick.length_m);
    if (best.length_m > 0.0) star_ratio.push_back(ours_m / best.length_m);
    for (int k = 0; k < 10; ++k) {
      const double angle = 6.28318530717958648 * unit(random);
      const Eigen::Vector2d next = goal + Eigen::Vector2d(std::cos(angle), std::sin(angle));
      if (!map.isClear(goal, next, kBody_m) || map.isClear(start, next, kBody_m)) continue;
      goal = next;
      begin = nowMs();
      planner.plan(start, goal, plan);
      again.push_back(nowMs() - begin);
    }
  }
  if (first.empty()) return;
  int sooner = 0;
  for (std::size_t i = 0; i < first.size(); ++i) sooner += first[i] < connect[i] ? 1 : 0;
  const double worst =
      star_ratio.empty() ? 0.0 : *std::max_element(star_ratio.begin(), star_ratio.end());
  std::printf(
      "%s (%dx%d), %zu queries, medians: prepare %.2f ms once, first plan %.3f ms, goal moved by "
      "1 m %.3f ms (%.3f of the first, %.4f of preparing and the first); RRT-Connect %.3f ms, ours "
      "sooner in %d; our length %.3f of its; RRT* 1 s solved %zu, "
      "our length %.3f of its (worst %.3f)\n",
      name.c_str(), grid.width(), grid.height(), first.size(), prepare_ms, middleOf(first),
      middleOf(again), middleOf(again) / middleOf(first),
      middleOf(again) / (prepare_ms + middleOf(first)), middleOf(connect), sooner,
      middleOf(connect_ratio), star_ratio.size(), middleOf(star_ratio), worst);
}

}  // namespace
}  // namespace heel

int main(int argc, char** argv) {
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  ompl::RNG::setSeed(1);
  for (int i = 1; i + 1 < argc; i += 2) {
    heel::compare(argv[i], heel::readPgm(argv[i], std::atof(argv[i + 1])));
  }
  if (argc == 1) {
    std::mt19937 random(1);
    heel::compare("drawn 8 m", heel::test::randomMap(random, 18).grid());
    heel::compare("drawn 16 m", heel::test::randomMap(random, 70, 16.0).grid());
  }
}
