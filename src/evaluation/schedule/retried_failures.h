// SPDX-License-Identifier: Apache-2.0
// Failed trials that are to be tried again.
//
// A journal is never rewritten: a mark says that what failed before it, or what failed of it for a
// limit of time or memory, does not count any more. The search asks for such points anew; what
// comes of them is a further trial of the same point. As the mark stays, a run that is interrupted
// and goes on tries the same ones.
#pragma once

#include <limits>
#include <utility>

#include "evaluation/journal/asked_trials.h"
#include "evaluation/journal/journal.h"

namespace latsch {

/// What a trial is allowed. 0: as much as it takes.
struct TrialLimits {
  double timeout = 0.0;          // s, of a trial
  double program_timeout = 0.0;  // s, of the outside program in it
  double memory = 0.0;           // bytes
};

/// All that failed so far is to be tried again; how many points these are.
long retry_failures(Journal& journal);

/// Keeps the limits that hold from now on. What failed for one that was lower until now is to be
/// tried again; how many points these are.
long retry_what_limits_forbade(Journal& journal, const TrialLimits& limits);

/// A journal without the failures that are to be tried again.
class TrialsThatCount : public TrialStore {
 public:
  explicit TrialsThatCount(Journal& journal) : read_(&journal), written_(&journal) {}
  /// For reading; of its first trials alone, and of these what was asked for.
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
