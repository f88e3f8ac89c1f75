// SPDX-License-Identifier: Apache-2.0
// Repeats failed trials.
//
// A journal is never rewritten. A mark says that earlier failures, or those due to a limit of time
// or memory, do not count any more. The search then requests such points again, and their outcome
// is a further trial of the same point. The mark stays, so an interrupted and resumed run repeats
// the same points.
#pragma once

#include <limits>
#include <utility>

#include "evaluation/journal/asked_trials.h"
#include "evaluation/journal/journal.h"

namespace latsch {

/// Limits of a trial. 0: unlimited.
struct TrialLimits {
  double timeout = 0.0;          // limit of the trial, s
  double program_timeout = 0.0;  // limit of the outside program in the trial, s
  double memory = 0.0;           // bytes
};

/// Marks all failures so far to be repeated. Returns the number of failed points.
long retry_failures(Journal& journal);

/// Stores the limits that hold from now on, and marks for repetition the trials that failed at a
/// limit that was stricter than the new one. Returns the number of the points of these trials.
long retry_what_limits_forbade(Journal& journal, const TrialLimits& limits);

/// View of a journal that leaves out the failures that are to be repeated.
class TrialsThatCount : public TrialStore {
 public:
  explicit TrialsThatCount(Journal& journal) : read_(&journal), written_(&journal) {}
  /// Creates a view for reading only, of the first `trials` of the journal and, of these, only the
  /// requested ones.
  explicit TrialsThatCount(const Journal& journal,
                           long trials = std::numeric_limits<long>::max(),
                           AskedTrials asked = AskedTrials({}))
      : read_(&journal), trials_(trials), asked_(std::move(asked)) {}

  void append(std::span<const Trial> trials) override;
  void for_each(const std::function<void(const Trial&)>& visit) const override;
  void begin_asking() override;
  void keep_asked(const std::set<std::string>& points) override;

 private:
  const Journal* read_;
  Journal* written_ = nullptr;
  long trials_ = std::numeric_limits<long>::max();
  AskedTrials asked_{{}};
};

}  // namespace latsch
