// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Phase 1 as a stream: the empty scene, then the person to follow (section 2).
#pragma once

#include <heel/apps/follower/people_detector.hpp>

#include <cstdint>

namespace heel {

/// How long things take, and how far the person can get between two frames.
struct AcquisitionParams {
  /// The scene is empty for so long at the start, or until somebody comes, a second or more.
  double background_s = 5.0;
  double person_s = 10.0;  ///< The acquisition ends this long after the person entered.
  int confirm_frames = 2;  ///< Somebody is there when seen in so many frames: depth is noisy.
  /// A second person, or one who comes before background_s, is there when seen all this time.
  double others_s = 0.5;
  double max_missing_s = 1.0;  ///< A person who was not seen for longer has left.
  /// The person is no further from their last place than they walk at this speed, and max_jump_m.
  double max_speed_mps = 3.0;
  double max_jump_m = 0.3;  ///< Added to the way that max_speed_mps allows.
  /// Far away depth is coarse, and breaks one body into two, one behind the other. What is this
  /// near to the ray of sight through the person (and within max_split_m) is theirs.
  double ray_width_m = 0.35;
  /// What is no further than this before or behind the person, along the ray of sight, is theirs;
  /// see ray_width_m.
  double max_split_m = 0.8;
  /// What is higher than this is labelled as torso, the rest as legs.
  double min_learn_height_m = 1.0;
  /// The person's pixels are those that differ in depth and in intensity: depth alone takes in a
  /// rim of the room. If a smaller share than this differs in intensity, the clothes have the
  /// wall's colour, and depth alone counts. Beside somebody in other clothes, though, such a blob
  /// is noise on a plain wall, and the frame is not used.
  double min_changed_share = 0.5;
  PeopleDetectorParams detector;
};

enum class AcquisitionState {
  kEmptyScene,  ///< Learns the background.
  kWaiting,     ///< For the first person to enter.
  kPerson,      ///< Collects the person's points.
  kEnded,
};

/// Why an acquisition ended.
enum class AcquisitionEnd {
  kNotYet,
  kTimeIsUp,      ///< As planned.
  kSecondPerson,  ///< Somebody else came into view; frames with them are not used.
  kPersonLeft,    ///< Not seen for max_missing_s.
};

/// A few words for people, e.g. "a second person came into view".
const char* toText(AcquisitionEnd end);

/// What an acquisition rests on, so far.
struct AcquisitionResult {
  AcquisitionState state = AcquisitionState::kEmptyScene;
  AcquisitionEnd end = AcquisitionEnd::kNotYet;
  int empty_frames = 0;       ///< The background's.
  bool was_empty = true;      ///< Nobody walked about in them.
  int waiting_frames = 0;     ///< With nobody in view.
  int person_frames = 0;      ///< With the person in view.
  int missed_frames = 0;      ///< Since the person entered, without them in view.
  long points = 0;            ///< Of the person, in all frames.
  double first_seen_s = 0.0;  ///< Stamp; 0 if nobody came.
  double last_seen_s = 0.0;
  Eigen::Vector2d last_place_m = Eigen::Vector2d::Zero();  ///< Of the person, in the base frame.

  /// Share of the frames since the person entered that show them; 0 without a person.
  double confidence() const {
    const int frames = person_frames + missed_frames;
    return frames == 0 ? 0.0 : static_cast<double>(person_frames) / frames;
  }
};

/// What one frame brought. Images and cloud are the detector's and valid until the next frame.
struct AcquisitionStep {
  /// Values of `labels`.
  static constexpr std::uint8_t kScene = 0;    ///< Not the person: the room's colours.
  static constexpr std::uint8_t kUnknown = 1;  ///< Changed, but not surely the person's.
  static constexpr std::uint8_t kTorso = 2;    ///< The person's, above min_learn_height_m.
  static constexpr std::uint8_t kLegs = 3;     ///< The person's, below it.

  AcquisitionState state = AcquisitionState::kEmptyScene;
  /// Whether labels may be learned from: the scene is empty, or the person alone is in view.
  bool usable = false;
  cv::Mat labels;                    ///< CV_8UC1, each pixel of the frame.
  const PeopleView* view = nullptr;  ///< Null while the background is learned.
  int person = -1;                   ///< The person's blob in the view, or -1.
};

/// The first phase: feed frames until `result().state` is kEnded, and learn from what step() gives.
class Acquisition {
 public:
  /// @throws std::invalid_argument  if a parameter is out of its range.
  Acquisition(const PinholeCamera& camera, const Eigen::Isometry3d& T_base_camera,
              const AcquisitionParams& params = {});

  /// Takes the next frame of a robot that stands still. After the end, frames are ignored.
  /// @param stamp_s  Not before the last one's.
  /// @throws std::invalid_argument  if the images do not fit, or the stamp runs backwards; the
  ///                                frame is then as if it had not been given.
  const AcquisitionStep& step(double stamp_s, const cv::Mat& image_bgr, const cv::Mat& depth_m);

  const AcquisitionResult& result() const { return result_; }

  /// Empty until the empty scene has been learned.
  const BackgroundModel& background() const { return background_; }

 private:
  void findPerson(double stamp_s);
  bool showsSomebody(double elapsed_s, const cv::Mat& image_bgr, const cv::Mat& depth_m);
  void countPoints(const PeopleView& view);
  void tellPeopleApart();
  void leaveOutNoise(double stamp_s);
  bool othersStay(double stamp_s);
  bool somebodyElseIsThere(double stamp_s) const;
  bool isElsewhere(int blob, double stamp_s) const;
  void forgetPerson();
  void labelPixels();
  bool looksLikeTheWall(int blob) const;

  AcquisitionParams params_;
  PeopleDetector detector_;
  Eigen::Vector2d eye_m_;  // the camera, on the floor
  struct PointCount {
    long all = 0;
    long changed = 0;  // which look otherwise than the room
  };
  std::vector<PointCount> points_;  // of each blob in the view
  std::vector<int> people_;         // blobs of different people in the view
  bool is_noisy_ = false;           // besides noise
  BackgroundLearner learner_;
  BackgroundModel background_;
  AcquisitionResult result_;
  AcquisitionStep step_;
  bool started_ = false;
  double start_s_ = 0.0;
  double stamp_s_ = 0.0;
  int frames_with_others_ = 0;  // in a row, ...
  double with_others_s_ = 0.0;  // and since when
};

}  // namespace heel
