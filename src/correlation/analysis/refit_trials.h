// SPDX-License-Identifier: Apache-2.0
// The trials of refits, kept as reduced rows (reduced_rows.h).
//
// Profiles and a cross-validation take thousands of trials. If a model knows its slopes, the
// recording of one trial with the slopes in n variables is n + 1 times as long as the recording
// alone: some megabytes. A refit needs only the reduced residuals and derivatives, some kilobytes.
// So these trials are kept reduced, in a journal of their own beside that of the study,
// JOURNAL.refits: an interrupted identification goes on with it, and a report reads it.
//
// A trial whose target is less than that of all before it is a result: it goes whole into the
// journal of the study, where every reader looks for the best trial.
//
// The file is a cache. It may be deleted at any time; latsch identify then runs these trials again.
// A channel in it belongs to the residuals, their derivatives and the groups at one point, which
// its name holds as a hash. Trials of other ones, of changed weights for example, are not read.
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
  /// The trials of `journal`, which belongs to the study, are known, too. `groups`: the residuals
  /// that are used; `at`: where the refits begin, in the rows used. `better`: the same journal, for
  /// trials better than its best one; the file is then created, and one of another study is
  /// replaced. nullptr: nothing is written, and the file is read where it is there.
  RefitTrials(const Study& study,
              const Journal& journal,
              RowGroups groups,
              const Linearization& at,
              Journal* better);

  /// The reduced residuals with their derivatives by the values of the variables. A trial that
  /// brings no derivatives is a Failure.
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
  std::unique_ptr<Journal> kept_;  // nullptr: none to read
};

/// Returns how many trials are kept beside the journal.
long refit_trial_count(const Journal& journal);

}  // namespace latsch::correlation
