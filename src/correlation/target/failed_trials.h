// SPDX-License-Identifier: Apache-2.0
// Counts the failed trials of a study in a journal by the reasons of their failures.
//
// A fit in which most trials failed still ends with a best point, but its confidence intervals and
// the reason why it ended do not reveal the failures. Exceeding a time limit is a special reason:
// on another machine other trials exceed it, so the result cannot be reproduced.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "correlation/study/study.h"
#include "evaluation/journal/journal.h"

namespace latsch::correlation {

struct FailedTrials {
  long trials = 0;     // number of trials that are counted
  long failed = 0;     // number of trials without a value of the target
  long timed_out = 0;  // number of failed trials that took longer than allowed
  /// reasons of the failures, each with its number of trials; the most frequent first
  std::vector<std::pair<std::string, long>> reasons;

  /// True if failures affect the result: at least half of the trials failed, or some exceeded a
  /// time limit.
  bool is_doubtful() const { return failed > 0 && (2 * failed >= trials || timed_out > 0); }
};

/// Counts the failed trials of a journal, including recordings without a value of the target. A
/// failure that will be repeated is not counted (evaluation/schedule/retried_failures.h).
FailedTrials failed_trials(const Study& study, const Journal& journal);

/// Returns a sentence such as "16 of 19 trials failed: 16 because ..."; it states at most three
/// reasons. Empty if no trial failed.
std::string in_words(const FailedTrials& failures);

}  // namespace latsch::correlation
