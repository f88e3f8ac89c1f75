// SPDX-License-Identifier: Apache-2.0
#include "correlation/search/search_standing.h"

#include <fmt/format.h>

#include "correlation/search/stage_runs.h"
#include "correlation/target/study_trials.h"
#include "evaluation/journal/asked_trials.h"

namespace latsch::correlation {
namespace {

/// True if the journal contains the search of the study as it stands from its start to its end.
bool has_recorded_ending(const Study& study, const Journal& journal) {
  try {
    return recorded_stages(study, journal).has_ended;
  } catch (const std::exception&) {
    return false;  // a stage is missing, or belongs to another model
  }
}

}  // namespace

TrialCounts count_trials(const Study& study, const Journal& journal) {
  const Objective target = objective(study);
  const TrialOwnership ownership(study, journal.marks());
  const AskedTrials asked(journal.marks());
  TrialCounts counts;
  journal.for_each([&](const Trial& trial) {
    const auto& result = trial.outcome.result;
    const bool has_target = result && target(trial.point, *result);
    const bool is_own = !ownership.is_known() || ownership.is_own(counts.trials, trial.point);
    const bool is_asked = asked.contains(counts.trials, trial.point);
    ++counts.trials;
    if (!has_target) ++counts.failed;
    if (!is_own) ++counts.foreign;
    if (has_target && is_own && is_asked) ++counts.own_succeeded;
  });
  return counts;
}

std::string why_no_best(const Study& study,
                        const TrialCounts& counts,
                        const TrialOwnership& ownership,
                        bool may_have_ended) {
  if (ownership.has_ended() || counts.succeeded() == 0) return "";
  const std::string next =
      fmt::format("Next: latsch run {}, which reuses its trials", study.file.string());
  if (ownership.is_known()) {
    if (counts.own_succeeded > 0) return "";
    return fmt::format(
        "no search has run on the study as it stands: {} holds {}. The nearest of them is no best "
        "point. {}",
        study.run.journal.string(),
        in_words(counts),
        next);
  }
  if (may_have_ended) return "";
  return fmt::format(
      "it is not known whether a search has run on the study as it stands: {} holds {}, of an "
      "older version of Latsch, which did not record for which measurements, weights and bounds "
      "they were run, and the search of the study as it stands does not end in them. The nearest "
      "of them is no best point. {}",
      study.run.journal.string(),
      in_words(counts),
      next);
}

std::string why_no_best(const Study& study, const Journal& journal) {
  const TrialOwnership ownership(study, journal.marks());
  if (ownership.has_ended() || journal.size() == 0) return "";
  const bool may_have_ended = !ownership.is_known() && has_recorded_ending(study, journal);
  return why_no_best(study, count_trials(study, journal), ownership, may_have_ended);
}

void require_best(const Study& study, const Journal& journal) {
  const std::string why = why_no_best(study, journal);
  if (!why.empty()) throw InputError({study.file.string(), 0}, why);
}

}  // namespace latsch::correlation
