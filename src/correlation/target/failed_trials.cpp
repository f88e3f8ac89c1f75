// SPDX-License-Identifier: Apache-2.0
#include "correlation/target/failed_trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "correlation/target/study_trials.h"
#include "evaluation/schedule/retried_failures.h"

namespace latsch::correlation {

FailedTrials failed_trials(const Study& study, const Journal& journal) {
  const Objective target = objective(study);
  FailedTrials found;
  std::map<std::string, long> counts;
  TrialsThatCount(journal).for_each([&](const Trial& trial) {
    ++found.trials;
    const auto& result = trial.outcome.result;
    const auto score = result ? target(trial.point, *result) : Result<Score>(result.failure());
    if (score) return;
    ++found.failed;
    if (score.failure().cause == Cause::timeout) ++found.timed_out;
    ++counts[score.failure().reason];
  });
  found.reasons.assign(counts.begin(), counts.end());
  std::ranges::stable_sort(found.reasons,
                           [](const auto& a, const auto& b) { return a.second > b.second; });
  return found;
}

std::string in_words(const FailedTrials& failures) {
  constexpr std::size_t kMostReasons = 3;
  if (failures.failed == 0) return "";
  std::string text = fmt::format("{} of {} trials failed", failures.failed, failures.trials);
  long told = 0;
  for (std::size_t i = 0; i < std::min(kMostReasons, failures.reasons.size()); ++i) {
    const auto& [reason, count] = failures.reasons[i];
    text += fmt::format("{} {} because: {}", i == 0 ? ":" : ";", count, reason);
    told += count;
  }
  if (told < failures.failed) text += fmt::format("; {} for other reasons", failures.failed - told);
  if (failures.timed_out > 0)
    text +=
        ". A limit of time makes the result depend on the speed of the machine: raise timeout in "
        "[run], or in [simulator] if it is that of an outside program, and resume, which repeats "
        "these trials";
  return text;
}

}  // namespace latsch::correlation
