// SPDX-License-Identifier: Apache-2.0
// Why trials of a journal failed: the failures of a study's trials, counted by their reason.
//
// A fit that lost most of its trials still ends with a best point, whose intervals and ending say
// nothing of the lost ones. A limit of time is a special reason: other trials miss it on another
// machine, so the result is not repeatable.
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

  /// True if failures decide the result: at least half of the trials failed, or some at a limit
  /// of time.
  bool is_doubtful() const { return failed > 0 && (2 * failed >= trials || timed_out > 0); }
};

/// Counts the failures of the journal, including recordings that have no target. A failure that is
/// to be repeated does not count (evaluation/schedule/retried_failures.h).
FailedTrials failed_trials(const Study& study, const Journal& journal);

/// Returns for example "16 of 19 trials failed: 16 because ...". At most three reasons are written
/// out. Empty if no trial failed.
std::string in_words(const FailedTrials& failures);

}  // namespace latsch::correlation
