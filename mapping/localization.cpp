// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/mapping/localization.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace heel {
namespace {

constexpr double kKldError = 0.05;      // That KLD sampling allows, see kldParticles().
constexpr double kKldQuantile = 2.326;  // Of the normal distribution: 99 %.
constexpr double kBin_m = 0.2;          // Edge of the bins of position that KLD sampling counts.
constexpr double kBin_rad = 0.175;      // Width of the bins of heading.
// Particles are drawn anew when a smaller share of them is effective.
constexpr double kResampleBelow = 0.5;
// A scan is weighed after this way or turn: the same view twice is no news.
constexpr double kMinMove_m = 0.05;
constexpr double kMinTurn_rad = 0.05;
// Particles of a cluster are no further than this from its mean.
constexpr double kCluster_m = 0.5;
constexpr double kCluster_rad = 0.5;
constexpr double kSureShare = 0.8;   // Of the weight, in the largest cluster; less is not sure.
constexpr int kConfirmingScans = 8;  // So many weighed scans must agree with a place found anew.
// Where the fit has fallen to this share of what was usual, a better place is searched for; the
// robot is lost until the whole map has been searched and none was found.
constexpr double kLostDrop = 0.75;
constexpr double kFastRate = 0.15;     // Weight of a new scan in the fit's short average,
constexpr double kSlowRate = 0.005;    // and in the usual fit.
constexpr std::size_t kRivals = 1000;  // Particles that may be anywhere else.
// Chance that the robot was carried off, or its odometry failed, before a scan that is weighed: to
// any of the places on the map.
constexpr double kCarriedOff = 1e-3;

/// While lost, each scan tries this share of the poses of a whole search, and no more than so many.
constexpr double kEffortWhileLost = 0.2;
constexpr double kMostWhileLost = 40000.0;
/// So much of the rivals is found anew with each scan.
constexpr double kNewRivals = 0.25;

const LocalizationParams& checked(const LocalizationParams& p) {
  if (p.min_particles == 0 || p.max_particles < p.min_particles) {
    throw std::invalid_argument("Localization: 0 < min_particles <= max_particles must hold");
  }
  if (!(p.near_m > 0.0)) throw std::invalid_argument("Localization: near_m must be positive");
  if (!(p.evidence > 0.0 && p.evidence <= 1.0)) {
    throw std::invalid_argument("Localization: evidence must be above 0 and at most 1");
  }
  return p;
}

}  // namespace

Localization::Localization(const OccupancyGrid& map, const FloorPose& T_base_scanner,
                           const LocalizationParams& params)
    : params_(checked(params)),
      field_(map, params.field),
      beams_(T_base_scanner, params.scan),
      search_(map, params.field, params.search),
      random_(params.seed),
      bins_(kBin_m, kBin_rad, params.max_particles) {
  params_.near_m = std::max(params_.near_m, map.cell_size_m());  // No map is more exact than that.
  particles_.reserve(params.max_particles);
  drawn_.reserve(params.max_particles);
  rivals_.reserve(std::max(params.max_particles, kRivals));
  for (auto* values : {&cosine_, &sine_, &log_likelihood_}) values->reserve(params.max_particles);
  bin_of_.reserve(params.max_particles);
}

void Localization::startAt(const FloorPose& pose, double place_m, double heading_rad) {
  if (!pose.position.allFinite() || !std::isfinite(pose.yaw_rad)) {
    throw std::invalid_argument("localization: the start is not finite");
  }
  particles_.clear();
  for (std::size_t i = 0; i < params_.max_particles; ++i) particles_.add(pose);
  shakeParticles(place_m, heading_rad, 0, random_, particles_);
  particles_.setEqualWeights();
  rivals_.clear();
  pending_.clear();
  search_everywhere_ = false;
  news_ = true;
  unfit_ = false;
  confirmed_ = kConfirmingScans;
  cluster_pose_ = pose;
  estimate_ = {};
  estimate_.pose = pose;
  estimate_.covariance =
      Eigen::Vector3d(place_m * place_m, place_m * place_m, heading_rad * heading_rad).asDiagonal();
  estimate_.cluster_share = own_share_ = 1.0;
  estimate_.lost = false;
}

void Localization::startAnywhere() {
  particles_.clear();
  rivals_.clear();
  pending_.clear();
  search_everywhere_ = true;
  news_ = true;
  unfit_ = false;
  confirmed_ = 0;
  estimate_ = {};
}

void Localization::predict(const FloorPose& increment) {
  if (!increment.position.allFinite() || !std::isfinite(increment.yaw_rad)) return;
  pending_.add(increment);
  if (!search_everywhere_) estimate_.pose = cluster_pose_ * pending_.motion();
}

bool Localization::update(const LaserScan& scan, const std::vector<FloorDisc>& leave_out,
                          const FloorPose& T_base_then) {
  const FloorPose& way = pending_.motion();
  const double way_m = way.position.norm(), turned_rad = std::abs(way.yaw_rad);
  const bool moved = way_m >= kMinMove_m || turned_rad >= kMinTurn_rad;
  if (beams_.choose(scan, leave_out, T_base_then).size() == 0) {
    if (moved && !search_everywhere_) driveBlindly();
    return false;
  }
  if (!moved && !news_) {
    judge();
    if (unfit_ || rivals_.size() > 0) compare(0.0);
    return false;
  }
  if (search_everywhere_) {
    search_.find(beams_.ends(), search_.poses(), params_.max_particles, random_, particles_);
    particles_.setEqualWeights();
    search_everywhere_ = false;
    telling_ = beams_.ends();
  } else {
    // A beam that ends before the map's wall tells of somebody, not of another place.
    scanResiduals(field_, beams_.ends(), estimate_.pose, beams_.T_base_scanner(), params_.near_m,
                  &telling_);
    moveAll();
  }
  const double another_view = std::min(way_m / kCluster_m + turned_rad / kCluster_rad, 1.0);
  pending_.clear();
  weigh(telling_, particles_);
  ++confirmed_;
  adopt(heaviestCluster(particles_));
  judge();
  if (unfit_ || rivals_.size() > 0) compare(another_view);
  resample();
  news_ = false;
  return true;
}

void Localization::moveAll() {
  moveParticles(pending_, params_.motion, random_, particles_);
  moveParticles(pending_, params_.motion, random_, rivals_);
  rival_pose_ = rival_pose_ * pending_.motion();
}

// A scan in which nothing is near enough tells nothing; how far the robot may be off by now does.
void Localization::driveBlindly() {
  moveAll();
  pending_.clear();
  adopt(heaviestCluster(particles_));
  estimate_.lost = estimate_.lost || own_share_ < kSureShare;
}

void Localization::weigh(const BeamEnds& ends, ParticleSet& particles) {
  const std::size_t count = particles.size();
  for (auto* values : {&cosine_, &sine_, &log_likelihood_}) values->resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    cosine_[i] = std::cos(particles.yaw_rad[i]);
    sine_[i] = std::sin(particles.yaw_rad[i]);
  }
  field_.score(ends, count, particles.x_m.data(), particles.y_m.data(), cosine_.data(),
               sine_.data(), log_likelihood_.data());
  particles.weigh(log_likelihood_.data(), params_.evidence);
}

// The estimate and its best rival each explain the scans; the better one is the estimate. What the
// map does not show is much the same in the next scan: only one from elsewhere is a witness of its
// own. What this scan has found is compared from the next one on.
void Localization::compare(double another_view) {
  const double carried_off =
      std::log(kCarriedOff / static_cast<double>(search_.poses()));  // to just there
  const bool anew = rivals_.size() == 0;
  if (anew) {
    rivals_log_odds_ = carried_off;
    searched_ = 0.0;
  } else {
    const Cluster rival = heaviestCluster(rivals_);
    const FloorPose change = rival_pose_.inverse() * rival.pose;
    if (isElsewhere(change)) rivals_log_odds_ = carried_off;
    rival_pose_ = rival.pose;
    const ScanResiduals residuals =
        scanResiduals(field_, beams_.ends(), rival.pose, beams_.T_base_scanner(), params_.near_m);
    // Once in a while it is carried off, whatever was seen before.
    const double better = logLikelihood(residuals) - logLikelihood(estimate_.residuals);
    rivals_log_odds_ = std::max(carried_off, rivals_log_odds_ + another_view * better);
    weigh(beams_.ends(), rivals_);
  }
  if (rivals_log_odds_ > 0.0) {
    std::swap(particles_, rivals_);
    rivals_log_odds_ = std::max(-rivals_log_odds_, carried_off);
    rival_pose_ = estimate_.pose;
    adopt(heaviestCluster(particles_));
    judge();
  }
  estimate_.cluster_share = own_share_ / (1.0 + std::exp(rivals_log_odds_));
  estimate_.lost = estimate_.lost || estimate_.cluster_share < kSureShare || searched_ < 1.0;
  if (!unfit_ && rivals_log_odds_ <= carried_off) {
    rivals_.clear();
    return;
  }
  const auto found =
      static_cast<std::size_t>((anew ? 1.0 : kNewRivals) * static_cast<double>(kRivals));
  const double poses =
      std::min(kEffortWhileLost * static_cast<double>(search_.poses()), kMostWhileLost);
  searched_ += poses / static_cast<double>(search_.poses());
  drawn_.clear();
  drawSystematic(rivals_, kRivals - found, random_, drawn_);
  search_.find(beams_.ends(), static_cast<std::size_t>(std::ceil(poses)), found, random_, drawn_);
  drawn_.setEqualWeights();
  std::swap(rivals_, drawn_);
  if (anew) rival_pose_ = heaviestCluster(rivals_).pose;
}

// Of all the beams of a scan, by what the map says about them.
double Localization::logLikelihood(const ScanResiduals& r) const {
  const double hit = field_.logLikelihoodAt(0.0);
  const double missed = field_.logLikelihoodAt(params_.field.far_m);
  const double shorter = hit + ScanResiduals::kShorterCounts * (missed - hit);
  return params_.evidence * r.beams * (r.explained * hit + r.shorter * shorter + r.beyond * missed);
}

bool Localization::isElsewhere(const FloorPose& change) const {
  return change.position.norm() > kCluster_m || std::abs(change.yaw_rad) > kCluster_rad;
}

Localization::Cluster Localization::heaviestCluster(const ParticleSet& particles) {
  bins_.clear();
  bin_of_.resize(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i) {
    bin_of_[i] = static_cast<std::uint32_t>(
        bins_.add(particles.x_m[i], particles.y_m[i], particles.yaw_rad[i], particles.weight[i]));
  }
  const std::size_t heaviest = bins_.heaviest();
  Cluster cluster;
  FloorPose& mean = cluster.pose;
  // The mean of the heaviest bin, then of all that is near the mean, until it stays.
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    double mass = 0.0;
    Eigen::Vector2d place = Eigen::Vector2d::Zero(), heading = Eigen::Vector2d::Zero();
    Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const FloorPose p = particles.pose(i);
      const Eigen::Vector2d off = p.position - mean.position;
      const double turn = wrapped(p.yaw_rad - mean.yaw_rad);
      const bool belongs = round == 0 ? bin_of_[i] == heaviest
                                      : off.squaredNorm() <= kCluster_m * kCluster_m &&
                                            std::abs(turn) <= kCluster_rad;
      if (!belongs) continue;
      const auto w = static_cast<double>(particles.weight[i]);
      mass += w;
      place += w * p.position;
      heading += w * Eigen::Vector2d(std::cos(p.yaw_rad), std::sin(p.yaw_rad));
      const Eigen::Vector3d error(off.x(), off.y(), turn);
      square += w * error * error.transpose();
    }
    if (!(mass > 0.0)) break;
    const FloorPose next{place / mass, std::atan2(heading.y(), heading.x())};
    const Eigen::Vector3d shift(next.position.x() - mean.position.x(),
                                next.position.y() - mean.position.y(),
                                wrapped(next.yaw_rad - mean.yaw_rad));
    cluster.covariance = square / mass - shift * shift.transpose();
    cluster.share = std::min(mass, 1.0);
    mean = next;
  }
  return cluster;
}

void Localization::adopt(const Cluster& cluster) {
  const bool elsewhere = isElsewhere(estimate_.pose.inverse() * cluster.pose);
  // What was thought of another place says nothing about this one.
  if (elsewhere) {
    estimate_.fit = -1.0;
    confirmed_ = 0;
  }
  estimate_.covariance = cluster.covariance;
  estimate_.cluster_share = own_share_ = cluster.share;
  cluster_pose_ = estimate_.pose = cluster.pose;
}

void Localization::judge() {
  LocalizationEstimate& e = estimate_;
  e.residuals =
      scanResiduals(field_, beams_.ends(), e.pose, beams_.T_base_scanner(), params_.near_m);
  const double fit = e.residuals.fit();
  e.fit = e.fit < 0.0 ? fit : e.fit + kFastRate * (fit - e.fit);
  unfit_ = e.fit < params_.lost_fit || e.fit < kLostDrop * e.usual_fit;
  e.lost =
      e.fit < params_.lost_fit || e.cluster_share < kSureShare || confirmed_ < kConfirmingScans;
  if (!e.lost) e.usual_fit += kSlowRate * (fit - e.usual_fit);
}

void Localization::resample() {
  const auto size = static_cast<double>(particles_.size());
  const bool worn = news_ || particles_.effectiveSize() < kResampleBelow * size;
  if (!worn) return;
  // How many bins would survive, and with that how many particles it takes.
  drawn_.clear();
  drawSystematic(particles_, params_.max_particles, random_, drawn_);
  bins_.clear();
  for (std::size_t i = 0; i < drawn_.size(); ++i) {
    bins_.add(drawn_.x_m[i], drawn_.y_m[i], drawn_.yaw_rad[i], 1.0F);
  }
  const std::size_t needed = std::clamp(kldParticles(bins_.count(), kKldError, kKldQuantile),
                                        params_.min_particles, params_.max_particles);
  drawn_.clear();
  drawSystematic(particles_, needed, random_, drawn_);
  drawn_.setEqualWeights();
  std::swap(particles_, drawn_);
}

}  // namespace heel
