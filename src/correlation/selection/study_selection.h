// SPDX-License-Identifier: Apache-2.0
// Choice of the variables of a study that its measurements carry: applies coefficient_selection.h
// to the residuals and the executor of a study.
//
// All models are fitted to the same values, weighed by their noise and by what neighbors share of
// it, as for samples of the posterior. The weights of the study are no noise and do not enter, so
// the fit of the study itself may end beside the values of the choice. A recording is everything
// that the study takes from one [measurement.NAME] or one file, in however many experiments.
//
// The trials are stored in a journal of their own, STUDY.selection.latsch: most have candidates at
// values that a search of the study would never choose. The file is a cache, from which the same
// command continues.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "correlation/study/study.h"
#include "evaluation/executors/executor.h"
#include "evaluation/journal/journal.h"
#include "evaluation/schedule/scheduler.h"
#include "optimization/selection/coefficient_selection.h"

namespace latsch::correlation {

/// The choice of a study's variables.
struct StudySelection {
  SelectionSettings settings;
  DesignPoint start;  // start of the fits
  CoefficientSelection selection;
  /// Fit of the chosen variables to the other half of the recordings; nullopt unless asked for.
  std::optional<CoefficientSelection> refit = {};
  std::vector<std::string> choosing = {};  // recordings that chose
  std::vector<std::string> refitted = {};  // recordings of the refit; empty without one
  long trials = 0;                         // outcomes that the fits used

  const SelectedModel& chosen() const { return selection.path()[selection.best()]; }
  /// Returns the model whose values and intervals are reported: of the refit, or the chosen one.
  const SelectedModel& reported() const { return refit ? refit->path().front() : chosen(); }
  /// Returns the intervals of all variables in the unit cube; those of held ones have no width.
  Confidence intervals() const {
    return refit ? refit->confidence_of(reported()) : selection.confidence_of(chosen());
  }
  /// Returns the point of a model, in which dropped variables have exactly their values.
  DesignPoint point(const DesignSpace& space, const SelectedModel& model) const;
};

/// Returns the names of the recordings that are fitted, in the order of the study.
std::vector<std::string> fitted_recordings(const Study& study);

/// Returns the reason why no selection of the study is possible, in one sentence; empty if it is.
std::string why_no_selection(const Study& study);

/// Returns the study with its journal of the selection.
Study with_selection_journal(const Study& study);

/// Selects, beginning at the point `start`. Returns nullopt if a stop was requested, a Failure if
/// nothing can be selected.
std::optional<Result<StudySelection>> select_coefficients(const Study& study,
                                                          const DesignPoint& start,
                                                          Executor& executor,
                                                          Journal& journal,
                                                          const RunOptions& options);

/// Names the repetition of an experiment that would narrow a variable most, and the standard
/// deviations of the variable without and with it, in ranges.
struct HoldingRecording {
  std::string recording;
  double before = 0.0, after = 0.0;
};

/// Returns, for each unit, the recording whose repetition would narrow the unit's least known
/// variable most, by the slopes of the fit of all candidates; nullopt if none depends on it.
std::vector<std::optional<HoldingRecording>> holding_recordings(const Study& study,
                                                                const StudySelection& selected);

}  // namespace latsch::correlation
