// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/simulation/body.hpp>

#include <algorithm>
#include <cmath>

namespace heel {
namespace {

using Eigen::AngleAxisf;
using Eigen::Isometry3f;
using Eigen::Translation3f;
using Eigen::Vector3f;

// Lengths as shares of a person's height.
constexpr float kThigh = 0.245F, kShin = 0.235F, kSole = 0.042F;
constexpr float kUpperArm = 0.165F, kForearm = 0.14F;

/// How far the thighs swing, in radians, at a speed.
double thighSwing(double speed_mps) { return 0.45 * std::min(speed_mps / 1.3, 1.4); }

Isometry3f turnedY(float angle) { return Isometry3f(AngleAxisf(angle, Vector3f::UnitY())); }

/// Collects the parts of one body; lengths are in shares of the height, in a frame that is given.
class Sculptor {
 public:
  Sculptor(const ScenePerson& person, int index, std::vector<BodyPart>& parts)
      : height_(static_cast<float>(person.height_m)),
        build_(static_cast<float>(person.build)),
        index_(index),
        parts_(parts) {}

  /// A capsule from `a` to `b` in `frame`. Patterns follow `cloth` (a world frame).
  void add(const Isometry3f& frame, const Vector3f& a, const Vector3f& b, float radius_a,
           float radius_b, BodyCover cover, const Isometry3f& cloth) {
    // Build widens what is dressed; heads and hands stay as they are.
    const bool dressed = cover == BodyCover::kTop || cover == BodyCover::kTrousers;
    const float scale = height_ * (dressed ? build_ : 1.0F);
    parts_.push_back({frame * (a * height_), frame * (b * height_), radius_a * scale,
                      radius_b * scale, cover, index_, cloth.inverse()});
  }

  /// A limb: it hangs from the origin of `frame` down its Z axis. Returns the frame of its end.
  Isometry3f limb(const Isometry3f& frame, float length, float radius_a, float radius_b,
                  BodyCover cover) {
    const Vector3f end(0.0F, 0.0F, -length);
    add(frame, Vector3f::Zero(), end, radius_a, radius_b, cover, frame);
    return frame * Translation3f(end * height_);
  }

  Isometry3f at(const Isometry3f& frame, float x, float y, float z) const {
    return frame * Translation3f(Vector3f(x, y, z) * height_);
  }

 private:
  float height_;
  float build_;
  int index_;
  std::vector<BodyPart>& parts_;
};

/// One leg's joints at a phase of the gait.
struct LegPose {
  float hip;   ///< Forward is positive.
  float knee;  ///< Bent backwards is positive.
};

LegPose legPose(double phase, double swing) {
  const double forward = std::cos(phase);  // > 0 while the leg swings to the front.
  return {
      static_cast<float>(swing * std::sin(phase) + 0.08 * swing),
      static_cast<float>(swing * (0.15 + 1.7 * std::max(0.0, forward) * std::max(0.0, forward)))};
}

/// How far the ankle is below the hip, as a share of the height.
float legReach(const LegPose& leg) {
  return kThigh * std::cos(leg.hip) + kShin * std::cos(leg.hip - leg.knee);
}

void addLeg(Sculptor& sculptor, const Isometry3f& pelvis, float side, const LegPose& leg) {
  const Isometry3f hip = sculptor.at(pelvis, 0.0F, side * 0.05F, 0.0F) * turnedY(-leg.hip);
  const Isometry3f knee =
      sculptor.limb(hip, kThigh, 0.047F, 0.036F, BodyCover::kTrousers) * turnedY(leg.knee);
  const Isometry3f ankle = sculptor.limb(knee, kShin, 0.035F, 0.028F, BodyCover::kTrousers) *
                           turnedY(0.75F * (leg.hip - leg.knee));
  sculptor.add(ankle, {-0.015F, 0.0F, -0.012F}, {0.085F, 0.0F, -0.02F}, 0.028F, 0.021F,
               BodyCover::kShoes, ankle);
}

// From the hips to the shins.
void addSkirt(Sculptor& sculptor, const Isometry3f& pelvis) {
  sculptor.add(pelvis, {0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -kThigh - 0.25F * kShin}, 0.085F, 0.105F,
               BodyCover::kTrousers, pelvis);
}

void addArm(Sculptor& sculptor, const Isometry3f& chest, float side, float swing,
            const Outfit& outfit) {
  const Isometry3f shoulder = sculptor.at(chest, 0.0F, side * 0.112F, 0.172F) * turnedY(-swing) *
                              AngleAxisf(side * 0.12F, Vector3f::UnitX());
  const Isometry3f elbow = sculptor.limb(shoulder, kUpperArm, 0.034F, 0.026F, BodyCover::kTop) *
                           turnedY(-0.25F - 0.6F * std::max(0.0F, swing));
  const BodyCover sleeve = outfit.long_sleeves ? BodyCover::kTop : BodyCover::kSkin;
  const Isometry3f wrist = sculptor.limb(elbow, kForearm, outfit.long_sleeves ? 0.025F : 0.022F,
                                         outfit.long_sleeves ? 0.02F : 0.016F, sleeve);
  sculptor.limb(sculptor.at(wrist, 0.0F, 0.0F, -0.02F), 0.035F, 0.02F, 0.017F, BodyCover::kSkin);
}

void addTorso(Sculptor& sculptor, const Isometry3f& pelvis, const Isometry3f& chest) {
  const auto top = BodyCover::kTop;
  sculptor.add(pelvis, {0.0F, -0.042F, 0.02F}, {0.0F, 0.042F, 0.02F}, 0.056F, 0.056F,
               BodyCover::kTrousers, pelvis);
  for (const float side : {-1.0F, 1.0F}) {
    sculptor.add(chest, {0.0F, side * 0.036F, -0.045F}, {0.004F, side * 0.05F, 0.14F}, 0.056F,
                 0.062F, top, chest);
  }
  sculptor.add(chest, {0.004F, 0.0F, -0.045F}, {0.008F, 0.0F, 0.13F}, 0.06F, 0.066F, top, chest);
  sculptor.add(chest, {0.0F, -0.1F, 0.17F}, {0.0F, 0.1F, 0.17F}, 0.04F, 0.04F, top, chest);
  sculptor.add(chest, {0.0F, -0.04F, 0.195F}, {0.0F, 0.04F, 0.195F}, 0.036F, 0.036F, top, chest);
}

void addHead(Sculptor& sculptor, const Isometry3f& chest, const Outfit& outfit) {
  const auto hair = BodyCover::kHair;
  sculptor.add(chest, {0.0F, 0.0F, 0.19F}, {0.006F, 0.0F, 0.26F}, 0.033F, 0.031F, BodyCover::kSkin,
               chest);
  sculptor.add(chest, {0.018F, 0.0F, 0.27F}, {0.012F, 0.0F, 0.325F}, 0.041F, 0.049F,
               BodyCover::kSkin, chest);
  sculptor.add(chest, {0.06F, 0.0F, 0.305F}, {0.066F, 0.0F, 0.292F}, 0.006F, 0.009F,
               BodyCover::kSkin, chest);
  sculptor.add(chest, {-0.008F, 0.0F, 0.315F}, {-0.001F, 0.0F, 0.334F}, 0.05F, 0.052F, hair, chest);
  sculptor.add(chest, {0.018F, -0.018F, 0.345F}, {0.018F, 0.018F, 0.345F}, 0.036F, 0.036F, hair,
               chest);
  if (!outfit.long_hair) return;
  for (const float side : {-1.0F, 1.0F}) {
    sculptor.add(chest, {-0.012F, side * 0.022F, 0.31F}, {-0.026F, side * 0.03F, 0.21F}, 0.045F,
                 0.03F, hair, chest);
  }
}

}  // namespace

double strideLength(const ScenePerson& person, double speed_mps) {
  const double leg_m = (kThigh + kShin) * person.height_m;
  return std::max(4.0 * leg_m * std::sin(thighSwing(speed_mps)), 0.3);
}

void appendBody(const ScenePerson& person, int index, const BodyPose& pose,
                std::vector<BodyPart>& parts) {
  Sculptor sculptor(person, index, parts);
  const double swing = thighSwing(pose.speed_mps);
  const LegPose left = legPose(pose.gait_rad, swing);
  const LegPose right = legPose(pose.gait_rad + 3.14159265358979, swing);
  const auto height_m = static_cast<float>(person.height_m);
  const float hip_m = (std::max(legReach(left), legReach(right)) + kSole) * height_m;
  const auto sway = static_cast<float>(0.03 * std::sin(0.9 * pose.time_s + index));
  const auto turn = static_cast<float>(0.12 * swing / 0.45 * std::sin(pose.gait_rad));

  const Isometry3f pelvis = Translation3f(static_cast<float>(pose.position.x()),
                                          static_cast<float>(pose.position.y()), hip_m) *
                            AngleAxisf(static_cast<float>(pose.yaw_rad), Vector3f::UnitZ());
  const Isometry3f chest = sculptor.at(pelvis, 0.0F, 0.0F, 0.092F) *
                           AngleAxisf(turn, Vector3f::UnitZ()) *
                           turnedY(static_cast<float>(0.06 * swing));
  addLeg(sculptor, pelvis, 1.0F, left);
  addLeg(sculptor, pelvis, -1.0F, right);
  if (person.outfit.skirt) addSkirt(sculptor, pelvis);
  addTorso(sculptor, pelvis, chest);
  const auto arm = static_cast<float>(0.75 * swing * std::sin(pose.gait_rad));
  addArm(sculptor, chest, 1.0F, sway - arm, person.outfit);
  addArm(sculptor, chest, -1.0F, sway + arm, person.outfit);
  addHead(sculptor, chest, person.outfit);
}

}  // namespace heel
