// SPDX-License-Identifier: Apache-2.0
// How uncertain the computed values of every experiment are, fitted or predicted: prediction_band.h
// over the experiments of a study.
//
// No trial is made for it. The slopes of a value are those that its recording carries, or the
// differences over the trials that told the derivatives of the residuals; of an experiment with a
// test of its own that is only predicted, over those that tell what its measurement would be worth
// (measurement_gains.h).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "correlation/analysis/identifiability.h"

namespace latsch::correlation {

/// The delay of a recording (curve_delay.h) with its 95 % interval, s: its own scatter at given
/// variables, and what the variables move it by.
struct DelayBand {
  double value = 0.0, lower = 0.0, upper = 0.0;
  bool at_end = false;  // of the range it is looked for in: the interval is none

  /// "12.31 ms, 95 %: 12.2 .. 12.42 ms"
  std::string in_words() const;
};

/// Of one experiment, a value a row of its observable, in its SI unit.
struct ExperimentBand {
  std::vector<double> computed;      // at the best point; NaN: none, a mode without a partner
  std::vector<double> lower, upper;  // of the 95 % band; NaN: not known. Empty: of no value
  std::vector<double> noise;         // standard deviation of a measured value, stated or estimated
  int inside = 0, compared = 0;      // measured values inside band and noise, of so many
  std::vector<std::string>
      remarks;  // what makes the band wide or one-sided, or why it is not known

  std::optional<DelayBand> delay = {};

  bool is_known() const { return !lower.empty(); }
};

/// A trial that is in no journal.
struct KnownTrial {
  DesignPoint point;
  Channels channels;
};

/// One for every experiment of the study, as far as trials at and beside the point are known.
std::vector<ExperimentBand> prediction_bands(const Study& study,
                                             const Identifiability& what,
                                             const Journal& journal,
                                             const std::vector<KnownTrial>& others = {});

/// The widest band beside what is computed, and where: "+- 12 N (3.1 %), 20 mm"; empty where none
/// is known.
std::string widest_text(const StudyExperiment& experiment, const ExperimentBand& band);

/// "19 of 20 measured values"; empty where none is known.
std::string inside_text(const ExperimentBand& band);

}  // namespace latsch::correlation
