// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/acquisition.hpp>
#include <heel/apps/follower/param_checks.hpp>
#include <heel/apps/recording/time_span.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>

namespace heel {
namespace {

// Of the picture: who walks through sweeps as much, and more; who enters at the end covers less.
constexpr double kSweptShare = 0.1;
constexpr double kLeastEmpty_s = 1.0;  // Who comes later ends the empty scene.

}  // namespace

const char* toText(AcquisitionEnd end) {
  switch (end) {
    case AcquisitionEnd::kNotYet:
      return "not ended";
    case AcquisitionEnd::kTimeIsUp:
      return "its time was up";
    case AcquisitionEnd::kSecondPerson:
      return "a second person came into view";
    case AcquisitionEnd::kPersonLeft:
      return "the person left";
  }
  return "unknown";
}

Acquisition::Acquisition(const PinholeCamera& camera, const Eigen::Isometry3d& T_base_camera,
                         const AcquisitionParams& params)
    : params_(params),
      detector_(camera, T_base_camera, params.detector),
      eye_m_(T_base_camera.translation().head<2>()) {
  requireNotNegative("AcquisitionParams",
                     {params.background_s, params.person_s, params.others_s, params.max_missing_s,
                      params.max_speed_mps, params.max_jump_m, params.ray_width_m,
                      params.max_split_m, params.min_changed_share, params.min_learn_height_m});
  if (params.confirm_frames < 1) {
    throw std::invalid_argument("AcquisitionParams: confirm_frames must be at least 1");
  }
}

const AcquisitionStep& Acquisition::step(double stamp_s, const cv::Mat& image_bgr,
                                         const cv::Mat& depth_m) {
  if (!std::isfinite(stamp_s) || (started_ && stamp_s < stamp_s_)) {
    throw std::invalid_argument("acquisition: the stamp runs backwards");
  }
  step_.usable = false;
  step_.person = -1;
  step_.view = nullptr;
  if (result_.state == AcquisitionState::kEnded) return step_;

  const double start_s = started_ ? start_s_ : stamp_s;
  if (background_.empty()) {
    const double elapsed_s = stamp_s - start_s;
    const bool is_up = elapsed_s > params_.background_s + kSameTime_s;
    const bool is_empty = !is_up && !showsSomebody(elapsed_s, image_bgr, depth_m);
    if (is_empty) {
      learner_.add(image_bgr, depth_m);
      result_.empty_frames = learner_.frames();
      step_.labels.create(image_bgr.size(), CV_8UC1);
      step_.labels.setTo(AcquisitionStep::kScene);
      step_.usable = true;
      frames_with_others_ = 0;
    } else if (is_up || othersStay(stamp_s)) {
      frames_with_others_ = 0;
      background_ = learner_.model();
      result_.was_empty = background_.restlessShare() < kSweptShare;
      result_.state = AcquisitionState::kWaiting;
    }
  }
  if (!background_.empty()) {
    step_.view = &detector_.detect(background_, image_bgr, depth_m);
    countPoints(*step_.view);
    tellPeopleApart();
    leaveOutNoise(stamp_s);
    findPerson(stamp_s);
    labelPixels();
  }
  started_ = true;
  start_s_ = start_s;
  stamp_s_ = stamp_s;
  step_.state = result_.state;
  return step_;
}

// Against what was empty until then: noise is known by then.
bool Acquisition::showsSomebody(double elapsed_s, const cv::Mat& image_bgr,
                                const cv::Mat& depth_m) {
  if (elapsed_s < kLeastEmpty_s || learner_.frames() < params_.confirm_frames) return false;
  const PeopleView& view = detector_.detect(learner_.model(), image_bgr, depth_m);
  countPoints(view);
  return std::any_of(view.people.begin(), view.people.end(),
                     [this](int i) { return !looksLikeTheWall(i); });
}

void Acquisition::countPoints(const PeopleView& view) {
  points_.assign(view.blobs.size(), {});
  for (const pcl::index_t i : *view.candidates) {
    const int blob = detector_.blobOf((*view.cloud)[static_cast<std::size_t>(i)]);
    if (blob < 0) continue;
    PointCount& count = points_[static_cast<std::size_t>(blob)];
    ++count.all;
    count.changed += view.foreground.changed.data[i] != 0 ? 1 : 0;
  }
}

// Of several blobs on one ray only the greatest counts.
void Acquisition::tellPeopleApart() {
  people_.clear();
  const auto& blobs = step_.view->blobs;
  for (const int i : step_.view->people) {
    const Eigen::Vector2d sight = blobs[static_cast<std::size_t>(i)].position_m - eye_m_;
    const bool is_split = std::any_of(people_.begin(), people_.end(), [&](int other) {
      const Eigen::Vector2d to_other = blobs[static_cast<std::size_t>(other)].position_m - eye_m_;
      const Eigen::Vector2d ray = to_other.normalized();
      const double aside_m = std::abs(ray.x() * sight.y() - ray.y() * sight.x());
      const double apart_m = std::abs(sight.dot(ray) - to_other.norm());
      return aside_m < params_.ray_width_m && apart_m < params_.max_split_m;
    });
    if (!is_split) people_.push_back(i);
  }
}

// What differs from the room in depth alone is somebody in the wall's colour only if nobody else is
// there, and only where the person can be. Else depth is noise, and the person's outline not to be
// trusted either.
void Acquisition::leaveOutNoise(double stamp_s) {
  const bool somebody_differs =
      std::any_of(people_.begin(), people_.end(), [this](int i) { return !looksLikeTheWall(i); });
  const auto is_noise = [&](int i) {
    return looksLikeTheWall(i) && (somebody_differs || isElsewhere(i, stamp_s));
  };
  const auto noise = std::remove_if(people_.begin(), people_.end(), is_noise);
  is_noisy_ = noise != people_.end();
  people_.erase(noise, people_.end());
}

// The first to enter is the person; from then on they are the one nearest to their last place.
void Acquisition::findPerson(double stamp_s) {
  const auto end = [&](AcquisitionEnd why) {
    result_.state = AcquisitionState::kEnded;
    result_.end = why;
    step_.person = -1;
  };
  bool entered = result_.state == AcquisitionState::kPerson;
  const bool is_sure = result_.person_frames >= params_.confirm_frames;
  if (entered && !is_sure && people_.size() == 1 && somebodyElseIsThere(stamp_s)) {
    forgetPerson();  // the first look was noise, or this one is: begin with the newest
    entered = false;
  } else if (somebodyElseIsThere(stamp_s)) {
    if (othersStay(stamp_s)) end(AcquisitionEnd::kSecondPerson);
    return;
  }
  frames_with_others_ = 0;
  if (entered && stamp_s - result_.first_seen_s > params_.person_s + kSameTime_s) {
    return end(AcquisitionEnd::kTimeIsUp);
  }
  step_.usable = !is_noisy_;
  if (people_.empty()) {
    ++(entered ? result_.missed_frames : result_.waiting_frames);
    if (!entered || stamp_s - result_.last_seen_s <= params_.max_missing_s + kSameTime_s) return;
    if (is_sure) return end(AcquisitionEnd::kPersonLeft);
    return forgetPerson();  // it was noise: nobody has entered yet
  }
  if (!entered) {
    if (is_noisy_) return;
    result_.state = AcquisitionState::kPerson;
    result_.first_seen_s = stamp_s;
  }
  result_.last_place_m = step_.view->blobs[static_cast<std::size_t>(people_.front())].position_m;
  result_.last_seen_s = stamp_s;
  if (is_noisy_) return;
  ++result_.person_frames;
  step_.person = people_.front();
}

void Acquisition::forgetPerson() {
  result_.state = AcquisitionState::kWaiting;
  result_.person_frames = result_.missed_frames = 0;
  result_.points = 0;
  result_.first_seen_s = result_.last_seen_s = 0.0;
}

// Whether people who should not be there are there to stay.
bool Acquisition::othersStay(double stamp_s) {
  if (frames_with_others_++ == 0) with_others_s_ = stamp_s;
  const bool stay = stamp_s - with_others_s_ > params_.others_s - kSameTime_s;
  return stay && frames_with_others_ >= params_.confirm_frames;
}

// Several people, or one who is not the person.
bool Acquisition::somebodyElseIsThere(double stamp_s) const {
  return people_.size() > 1 || (people_.size() == 1 && isElsewhere(people_.front(), stamp_s));
}

// Whether the person can't have come there from their last place.
bool Acquisition::isElsewhere(int blob, double stamp_s) const {
  if (result_.state != AcquisitionState::kPerson) return false;
  const auto& place = step_.view->blobs[static_cast<std::size_t>(blob)].position_m;
  const double reach_m =
      params_.max_jump_m + params_.max_speed_mps * (stamp_s - result_.last_seen_s);
  return (place - result_.last_place_m).norm() > reach_m;
}

void Acquisition::labelPixels() {
  const Foreground& foreground = step_.view->foreground;
  const cv::Mat& mask = foreground.mask;
  step_.labels.create(mask.size(), CV_8UC1);
  for (int v = 0; v < mask.rows; ++v) {
    const auto* shown = mask.ptr<std::uint8_t>(v);
    const auto* changed = foreground.changed.ptr<std::uint8_t>(v);
    auto* labels = step_.labels.ptr<std::uint8_t>(v);
    for (int u = 0; u < mask.cols; ++u) {
      labels[u] =
          (shown[u] | changed[u]) != 0 ? AcquisitionStep::kUnknown : AcquisitionStep::kScene;
    }
  }
  if (step_.person < 0) return;
  const bool take_all = looksLikeTheWall(step_.person);
  const auto torso_m = static_cast<float>(params_.min_learn_height_m);
  for (const pcl::index_t i : *step_.view->candidates) {
    const auto& point = (*step_.view->cloud)[static_cast<std::size_t>(i)];
    if (!(take_all || foreground.changed.data[i] != 0)) continue;
    if (detector_.blobOf(point) != step_.person) continue;
    const bool torso = point.z > torso_m;
    step_.labels.data[i] = torso ? AcquisitionStep::kTorso : AcquisitionStep::kLegs;
    ++result_.points;
  }
}

bool Acquisition::looksLikeTheWall(int blob) const {
  const PointCount& count = points_[static_cast<std::size_t>(blob)];
  return static_cast<double>(count.changed) <
         params_.min_changed_share * static_cast<double>(count.all);
}

}  // namespace heel
