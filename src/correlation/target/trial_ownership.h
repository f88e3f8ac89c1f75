// SPDX-License-Identifier: Apache-2.0
// Distinguishes the trials of a journal that were run for the present study from those that were
// run for other measurements, weights or bounds.
//
// The channels of a trial depend only on the study's identity, so a journal keeps its trials when a
// measurement, a weight or a bound is edited. The least target among them is then no result: no
// search looked for it, and it is only the nearest of the points to which other data led. Therefore
// every run writes into the journal for which study it runs (Study::target_key) and when its search
// has ended. Until a search of the present study has ended, only trials that were run for it can be
// its best.
//
// Journals of older versions have no such marks. Ownership is then not known, and every trial can
// be the best; search/search_standing.h replays the search instead.
#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "correlation/study/study.h"
#include "evaluation/journal/journal.h"

namespace latsch::correlation {

class TrialOwnership {
 public:
  TrialOwnership(const Study& study, std::span<const JournalMark> marks);

  /// True if the journal has marks of ownership; journals of older versions have none.
  bool is_known() const { return is_known_; }
  /// True if a search of the present study has ended.
  bool has_ended() const { return has_ended_; }
  /// True if the trial in this row of the journal (the first is 0) was run for the present study.
  bool is_own(long row, const DesignPoint& point) const;
  bool can_be_best(long row, const DesignPoint& point) const {
    return !is_known_ || has_ended_ || is_own(row, point);
  }

 private:
  struct Stretch {
    long begin = 0;  // first row
    bool is_own = false;
  };
  bool is_known_ = false, has_ended_ = false;
  std::vector<Stretch> stretches_;  // in the order of the rows
  /// points that a design of experiments took from earlier trials
  std::set<std::uint64_t> taken_;
};

/// Marks that the following trials are run for the present study.
void mark_target(const Study& study, Journal& journal);

/// Marks that the following trials are copied from another journal.
void mark_taken_over(Journal& journal);

/// Marks that the search of a stage, or of a study without stages, has ended.
void mark_ended(const Study& stage, Journal& journal);

/// Marks the points that a design of experiments took from earlier trials of the journal: they
/// count as run for the present study.
void mark_design(const Study& study, const std::vector<DesignPoint>& points, Journal& journal);

/// Numbers of trials in a journal by their outcome and by the study for which they were run.
struct TrialCounts {
  long trials = 0;
  long failed = 0;   // trials without a target: failed, or their channels cannot be compared
  long foreign = 0;  // run for other measurements, weights or bounds; 0 if that is not known
  /// trials that succeeded, are not foreign, and were requested by a search or a design
  long own_succeeded = 0;
  long succeeded() const { return trials - failed; }
  long own() const { return trials - foreign; }
};

/// Returns the counts in words: "7 trials, 5 succeeded and 2 failed; 3 of them were run for other
/// measurements, weights or bounds".
std::string in_words(const TrialCounts& counts);
/// Returns the counts in words for a line below a result of the present study: "... simulated
/// earlier, for other measurements, ...: the search took them in place of new ones".
std::string in_words_below_result(const TrialCounts& counts);

}  // namespace latsch::correlation
