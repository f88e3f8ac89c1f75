// SPDX-License-Identifier: Apache-2.0
#include "correlation/target/best_trial.h"

#include <algorithm>
#include <utility>

#include "correlation/target/study_trials.h"
#include "correlation/target/trial_ownership.h"
#include "evaluation/journal/asked_trials.h"

namespace latsch::correlation {
bool keeps_held(const Study& study, const DesignPoint& point) {
  if (!study.held_at || study.free.empty()) return true;
  for (int i = 0; i < study.space.size(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    const bool is_free = std::binary_search(study.free.begin(), study.free.end(), i);
    if (!is_free && point.values[at] != study.held_at->values[at]) return false;
  }
  return true;
}

std::vector<RatedTrial> rated_trials(const Study& study, const Journal& journal) {
  const Objective target = objective(study);
  std::vector<RatedTrial> rated;
  const AskedTrials asked(journal.marks());
  long next = 0;
  journal.for_each([&](const Trial& trial) {
    const long row = next++;
    if (!asked.contains(row, trial.point) || !trial.outcome.result) return;
    const auto score = target(trial.point, *trial.outcome.result);
    if (score) rated.push_back({trial.point, score->value, violation(*score), row});
  });
  return rated;
}

std::vector<RatedTrial> rated_candidates(const Study& study, const Journal& journal) {
  auto rated = rated_trials(study, journal);
  const TrialOwnership ownership(study, journal.marks());
  std::erase_if(rated, [&](const auto& trial) {
    // The point may violate the present bounds or linear constraints, because earlier bounds were
    // wider or because a design of experiments ignores linear constraints.
    return !study.space.contains(trial.point) || !keeps_held(study, trial.point) ||
           !ownership.can_be_best(trial.row, trial.point);
  });
  return rated;
}

bool is_better(const RatedTrial& a, const RatedTrial& b) {
  const auto rank = [](const RatedTrial& trial) {
    return std::pair(std::max(trial.violation, kFulfilled), trial.target);
  };
  return rank(a) < rank(b);
}

std::optional<RatedTrial> best_trial(const Study& study, const Journal& journal) {
  const auto rated = rated_candidates(study, journal);
  const auto least = std::min_element(
      rated.begin(), rated.end(), [](const auto& a, const auto& b) { return is_better(a, b); });
  if (least == rated.end()) return std::nullopt;
  return *least;
}

}  // namespace latsch::correlation
