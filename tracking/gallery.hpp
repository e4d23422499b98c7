// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Everybody who is known, and what a look at a body says about who it is.
#pragma once

#include <heel/tracking/observation.hpp>

#include <Eigen/Core>

#include <limits>
#include <optional>
#include <vector>

namespace heel {

/// How a description changes with the light.
struct Tint {
  Eigen::ArrayXi bins;     ///< For each bin, the one that its pixels would be in.
  double log_prior = 0.0;  ///< How usual that light is, at most 0.
};

/// What phase 1 leaves, in the bins and parts of Observation::look.
struct TargetLooks {
  Eigen::ArrayXXf target;     ///< Mean of many looks; empty: nothing is known of anybody's looks.
  Eigen::ArrayXf room;        ///< How the room's pixels are spread over the bins.
  Eigen::ArrayXf anybody;     ///< How anybody's are, before they are known.
  std::vector<int> garments;  ///< Which of kGarments each part is of; empty: each part is one.
  std::vector<Tint> tints;    ///< In which people may be seen again, besides the room's own.
  std::optional<double> stature_m;
  double stature_sigma_m = 0.05;  ///< Of a single look's stature, without what all share.
};

/// Who or what a body may be.
enum Hypothesis : int {
  kThing,     ///< Furniture, a wall: no person.
  kStranger,  ///< A person who is not in the gallery.
  kTarget,
  kFirstOther,  ///< The first of the others in the gallery.
};
inline constexpr int kMostOthers = 7;
inline constexpr int kHypotheses = kFirstOther + kMostOthers;

/// A value a hypothesis.
using Evidence = Eigen::Array<double, kHypotheses, 1>;

/// What strangers may share with somebody, each by itself: trousers, a top, hair.
inline constexpr int kGarments = 3;
/// What looks say: a row a hypothesis, log odds over any stranger by each garment, and in the last
/// column by all else. A stranger's garments are those of one who wears the like of the target's;
/// their last column takes that off again.
using LookOdds = Eigen::Array<double, kHypotheses, kGarments + 1>;
/// Makes a row's sum this, by its last column.
template <typename Sums>
void setSums(LookOdds& odds, const Sums& sums) {
  odds.col(kGarments) = sums - odds.leftCols<kGarments>().rowwise().sum();
}

/// What a look's colours say, part by part.
struct LookEvidence {
  /// Log odds over any stranger, hypotheses x parts; 0 where nothing is said. A stranger's are
  /// those of one who wears what the target's clothes are like in any light.
  Eigen::ArrayXXd parts;
  Eigen::ArrayXXd misfits;            ///< KL(look || person) of each; -1 where nothing is said.
  Eigen::ArrayXd is_seen;             ///< 1 of the parts that it shows, else 0.
  Evidence light = Evidence::Zero();  ///< What the light says in which each fits best.
};

/// Logarithm of the likelihood of looks at one body by its stature, in steps of 2 cm from 1.2 m.
using Tallness = Eigen::Array<double, 51, 1>;

/// A look's log odds is the sum over its parts of (likeness + kLikenessOffset), where
/// likeness = kRarityShare * KL(look || anybody) - KL(look || person), in the light that fits best.
/// Sure looks at a person teach how well they usually fit, which adds what kMisfit says.
/// The offset was learned on people of real recordings by tests/benchmarks/look_fit.cpp, see
/// docs/results.md: another description of bodies needs another.
/// A part whose likeness is minus this says nothing.
inline constexpr double kLikenessOffset = 0.41;
/// Mean misfit, KL(look || person), of the looks at a person and at somebody else, over all parts
/// and lights: what is expected before a person was looked at. Whoever usually fits better than
/// that is not taken for them where they fit no better than others do.
inline constexpr double kMisfit = 0.97, kOthersMisfit = 2.0;
/// How much of a rare colour's evidence counts: whoever wears a rare colour wears much of it.
inline constexpr double kRarityShare = 0.5;

struct GalleryParams {
  /// Share of looks that mislead (shade, somebody half in front, a lintel over them). It bounds
  /// what one look at colours, and one at stature, can say against anybody. As many strangers wear
  /// the like of somebody's top, or trousers, or have such hair, each by itself, and its square all
  /// of it: that bounds what all looks can say for the target. Its square bounds what one look says
  /// for anybody.
  double misleading_share = 0.05;
  /// Looks at one person are alike: many together are worth no more than 1 / this of them.
  double look_correlation = 0.2;
};

/// The target, and the others who were met. Knows looks only: where anybody is, is Identity's.
class Gallery {
 public:
  /// @throws std::invalid_argument  if a parameter is out of its range, or sizes do not fit.
  explicit Gallery(TargetLooks looks = {}, const GalleryParams& params = {});

  /// Compares a look's colours with everybody's. What is not seen says nothing.
  void compare(const Observation& seen, LookEvidence& evidence);
  /// What a look's colours say together, bounded as GalleryParams say; 0 of who is nobody.
  /// @param known  What other looks say of the parts that it does not show, as LookEvidence::parts.
  LookOdds logOdds(const LookEvidence& look, const Eigen::ArrayXXd* known = nullptr) const;
  /// How much likelier looks are by a stranger who may wear the like of some of what the target
  /// does, or all, than by any, as a logarithm.
  double logAlike(const LookOdds& odds) const;

  /// What a look says of stature; 0 where it says nothing.
  Tallness logTallness(const Observation& seen) const;
  /// Logarithm of the likelihood of what was seen of a body's stature by each hypothesis, over a
  /// stranger's, things being of all heights; and of a stranger's.
  Evidence logLikelihood(const Tallness& log_tallness) const;
  double logIfAnybody(const Tallness& log_tallness) const;

  /// Another sure look at somebody. The target has two portraits, phase 1's and one of what was
  /// seen since, and a look is as likely as by both in the mean; phase 1's keeps half of the say.
  /// @param evidence  What compare() said of it.
  void addLookAt(int hypothesis, const Observation& seen, const LookEvidence& evidence,
                 double weight);

  /// Puts somebody new into the gallery, in the place of `replaced` or a free one (kStranger).
  /// @return  Their hypothesis; kStranger if there is no room, or if looks tell nothing.
  int meet(const Eigen::ArrayXXf& mean_look, double weight, int replaced = kStranger,
           const Tallness& log_tallness = Tallness::Zero());
  bool isKnown(int hypothesis) const { return people_[index(hypothesis)].portrait.weight > 0.0; }
  bool isFull() const { return isKnown(kHypotheses - 1); }
  const GalleryParams& params() const { return params_; }

 private:
  /// The mean of looks at somebody.
  struct Portrait {
    Eigen::ArrayXXf mean;
    Eigen::ArrayXXf log_shares;  // of a bin, with a little of anybody's,
    Eigen::ArrayXXf log_like;    // and of the mean in all lights
    std::vector<bool> knows;     // which parts
    double weight = 0.0;         // independent looks that it rests on
  };
  struct Person {
    Portrait portrait;                         // of weight 0: nobody
    Tallness log_tallness = Tallness::Zero();  // by looks,
    Tallness statures = Tallness::Zero();      // and what is known by it
    // Their usual misfits, part by part, and what these rest on.
    Eigen::ArrayXd misfit, misfit_weight;
  };
  /// A portrait in a light, and the log odds of the look at hand, with the share of such looks.
  struct Fit {
    const Portrait* portrait = nullptr;
    const Tint* tint = nullptr;
    double log_odds = -std::numeric_limits<double>::infinity();
  };
  /// Of a part; as it is where the part is not shown.
  struct PartFit {
    double misfit = -1.0;
    double log_odds = 0.0;
  };
  static std::size_t index(int hypothesis) { return static_cast<std::size_t>(hypothesis); }
  Portrait portraitOf(const Eigen::ArrayXXf& mean, double weight) const;
  void refresh(Portrait& portrait, Eigen::Index part) const;
  void refresh(Person& person) const;
  void takeApart(const Eigen::ArrayXXf& look, Eigen::ArrayXd& is_seen);
  Fit bestFit(const Person& person, const Portrait& portrait, double log_share) const;
  PartFit fitOf(const Fit& fit, const Eigen::ArrayXXf& log_shares, std::size_t part) const;
  double against(const Person& person, double misfit, std::size_t part) const;

  TargetLooks looks_;
  GalleryParams params_;
  Eigen::ArrayXf anybody_, log_anybody_;
  std::vector<Person> people_;  // by hypothesis
  Portrait lately_;             // of the target, since phase 1
  Tallness anybody_statures_ = Tallness::Zero();
  // The look at hand: bins that are not empty, part by part.
  struct Share {
    int bin;
    float share;
  };
  std::vector<Share> look_;
  std::vector<std::size_t> ends_;  // of the parts in look_
  std::vector<double> entropies_;  // sum of share * log(share) of each part
};

}  // namespace heel
