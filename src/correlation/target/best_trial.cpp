// SPDX-License-Identifier: Apache-2.0
#include "correlation/target/best_trial.h"

#include <algorithm>
#include <utility>

#include "correlation/target/study_trials.h"

namespace latsch::correlation {

std::vector<RatedTrial> rated_trials(const Study& study, const Journal& journal) {
  const Objective target = objective(study);
  std::vector<RatedTrial> rated;
  journal.for_each_asked([&](const Trial& trial) {
    if (!trial.outcome.result) return;
    const auto score = target(trial.point, *trial.outcome.result);
    if (score) rated.push_back({trial.point, score->value, violation(*score)});
  });
  return rated;
}

std::optional<RatedTrial> best_trial(const Study& study, const Journal& journal) {
  auto rated = rated_trials(study, journal);
  // A design of experiments may have looked beyond linear constraints.
  if (!study.space.constraints().empty()) {
    std::erase_if(rated, [&](const auto& trial) { return !study.space.contains(trial.point); });
  }
  const auto rank = [](const RatedTrial& trial) {
    return std::pair(std::max(trial.violation, kFulfilled), trial.target);
  };
  const auto least = std::min_element(
      rated.begin(), rated.end(), [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  if (least == rated.end()) return std::nullopt;
  return *least;
}

}  // namespace latsch::correlation
