// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/confusion_matrix.hpp>

namespace heel {

double ConfusionMatrix::share(std::size_t model_of, std::size_t person, DetectionRule rule) const {
  const DetectionRun& run = at(model_of, person);
  const int frames = rule == DetectionRule::kFollowed ? run.followed : run.blob;
  return run.frames_in_view == 0 ? 0.0 : static_cast<double>(frames) / run.frames_in_view;
}

bool ConfusionMatrix::detected(std::size_t model_of, std::size_t person, DetectionRule rule,
                               double min_share) const {
  const double found = share(model_of, person, rule);
  return found > 0.0 && found >= min_share;
}

ConfusionCount ConfusionMatrix::count(DetectionRule rule, double min_share,
                                      std::optional<std::size_t> without) const {
  ConfusionCount result;
  for (std::size_t model_of = 0; model_of < size(); ++model_of) {
    for (std::size_t person = 0; person < size(); ++person) {
      if (model_of == without || person == without) continue;
      const bool found = detected(model_of, person, rule, min_share);
      if (model_of == person) {
        result.false_negatives.add(!found);
      } else {
        result.false_positives.add(found);
      }
    }
  }
  return result;
}

Proportion ConfusionMatrix::identified(std::optional<std::size_t> without) const {
  Proportion result;
  for (std::size_t person = 0; person < size(); ++person) {
    if (person == without) continue;
    bool own_is_best = at(person, person).appearance() > 0.0;
    for (std::size_t model_of = 0; model_of < size(); ++model_of) {
      if (model_of == person || model_of == without) continue;
      own_is_best =
          own_is_best && at(person, person).appearance() > at(model_of, person).appearance();
    }
    result.add(own_is_best);
  }
  return result;
}

}  // namespace heel
