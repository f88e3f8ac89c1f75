// SPDX-License-Identifier: Apache-2.0
// The trials of refits, stored as reduced rows (reduced_rows.h).
//
// Profiles and a cross-validation take thousands of trials. If a model computes derivatives, the
// recording of one trial with the derivatives by n variables is n + 1 times as long as the
// recording alone: some megabytes. A refit needs only the reduced residuals and derivatives, some
// kilobytes. These trials are therefore stored in reduced form, in a separate file beside the
// journal of the study, JOURNAL.refits: an interrupted identification continues from it, and a
// report reads it.
//
// A trial with a smaller target than all earlier ones is a result: it is stored whole in the
// journal of the study, in which every reader searches for the best trial. The file is a cache. It
// may be deleted at any time; latsch identify then runs these trials again. The name of a channel
// contains a hash of the residuals, derivatives and groups at the point where the refits begin.
// Trials with another hash, for example after a change of weights, are not read.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "correlation/study/study.h"
#include "correlation/target/best_trial.h"
#include "evaluation/journal/journal.h"
#include "evaluation/trial/evaluator.h"
#include "optimization/identifiability/reduced_rows.h"

namespace latsch::correlation {

class RefitTrials : public TrialStore {
 public:
  /// Reads the refits of a study. Trials in `journal`, which belongs to the study, are used too.
  /// `groups` are the used residuals; `at` is the start of the refits, with the used rows alone.
  /// `better` is the same journal: trials better than its best one are added to it, and the file of
  /// refits is created, or replaced if it belongs to another study. If `better` is nullptr, the
  /// file is only read, if it exists.
  RefitTrials(const Study& study,
              const Journal& journal,
              RowGroups groups,
              const Linearization& at,
              Journal* better);

  /// Returns the reduced residuals and their derivatives by the variables' values. Returns a
  /// Failure for a trial without derivatives.
  Objective objective() const;

  void append(std::span<const Trial> trials) override;
  void for_each(const std::function<void(const Trial&)>& visit) const override;

  static std::filesystem::path file(const std::filesystem::path& journal);

 private:
  Result<Score> reduced(const DesignPoint& point, const Channels& channels) const;
  std::vector<double> packed(const Evaluated& rows) const;
  std::optional<Evaluated> unpacked(const std::vector<double>& numbers) const;
  std::size_t packed_size() const;
  bool is_best(const Trial& trial);

  const Study& study_;
  const Journal& journal_;
  Journal* better_;
  Objective residuals_, target_;
  RowGroups groups_;
  Eigen::Index variables_;
  std::string name_;  // name of the channel that holds the reduced residuals
  std::optional<RatedTrial> best_;
  std::unique_ptr<Journal> kept_;  // nullptr: there is no file to read
};

/// Returns the number of trials stored beside the journal.
long refit_trial_count(const Journal& journal);

}  // namespace latsch::correlation
