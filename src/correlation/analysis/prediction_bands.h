// SPDX-License-Identifier: Apache-2.0
// Uncertainty of the computed values of every experiment, fitted or predicted: applies
// prediction_band.h to the experiments of a study.
//
// No trial is run for the bands. The slopes of a value come from its recording, or from differences
// over the trials that gave the derivatives of the residuals. The slopes of an experiment that is
// only predicted and has a test of its own come from the trials of measurement_gains.h.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "correlation/analysis/identifiability.h"
#include "correlation/analysis/nuisance_table.h"

namespace latsch::correlation {

/// Delay of a recording (curve_delay.h) with its 95 % interval, s. The interval covers the delay's
/// own scatter at given variables and the change of the delay with the variables.
struct DelayBand {
  double value = 0.0, lower = 0.0, upper = 0.0;
  /// True if the delay lies at an end of its search range; then there is no interval.
  bool at_end = false;

  /// Returns for example "12.31 ms, 95 %: 12.2 .. 12.42 ms".
  std::string in_words() const;
};

/// Band of one experiment: one value for each row of its observable, in its SI unit.
struct ExperimentBand {
  std::vector<double> computed;      // at the best point; NaN for a mode without a partner
  std::vector<double> lower, upper;  // ends of the 95 % band; NaN: not known; empty: none known
  /// standard deviation of each measured value, stated or estimated
  std::vector<double> noise;
  /// Number of measured values inside band and noise, and number of compared values.
  int inside = 0, compared = 0;
  std::vector<std::string> remarks;  // reasons why the band is wide, one-sided or not known

  std::optional<DelayBand> delay = {};
  std::vector<NuisanceRow> nuisance = {};  // nuisance numbers of the recording
  /// Cost of all nuisance numbers of the study; set for the first experiment that has any.
  std::vector<NuisanceCost> nuisance_costs = {};
  std::vector<std::string> nuisance_remarks = {};  // numbers that act like a variable

  bool is_known() const { return !lower.empty(); }
};

/// A trial that is in no journal.
struct KnownTrial {
  DesignPoint point;
  Channels channels;
};

/// Returns one band for every experiment of the study, if trials at and beside the point are known.
std::vector<ExperimentBand> prediction_bands(const Study& study,
                                             const Identifiability& what,
                                             const Journal& journal,
                                             const std::vector<KnownTrial>& others = {});

/// Returns the band that is widest relative to its computed value, and the position of that value:
/// "+- 12 N (3.1 %), 20 mm"; empty if no band is known.
std::string widest_text(const StudyExperiment& experiment, const ExperimentBand& band);

/// Returns for example "19 of 20 measured values"; empty if no band is known.
std::string inside_text(const ExperimentBand& band);

}  // namespace latsch::correlation
