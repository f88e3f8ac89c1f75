// SPDX-License-Identifier: Apache-2.0
// Ranks possible measurements by the information that each would add about the variables: applies
// d_optimality.h to the experiments of a study.
//
// There are two kinds of candidates. Repeating a measured value costs no simulation, because its
// derivatives are known. An experiment with use = "predict" has not been fitted, so its derivatives
// need its simulation at the points of the differences. A candidate's values are assumed to be as
// exact as its stated noise or, if none is stated, as the fitted values.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "correlation/analysis/identifiability.h"

namespace latsch::correlation {

struct MeasurementGain {
  /// Name of the measurement, such as "modes once more", "stiffness at 20 mm once more",
  /// "footprint".
  std::string measurement;
  double shrinkage = 1.0;  // factor by which the volume of the confidence region shrinks
  int helps = 0;           // index of the variable whose deviation falls by the largest factor
  /// Standard deviation of a variable without and with the measurement, as a share of its range.
  double before = 0.0, after = 0.0;
};

/// Returns the mean relative noise that the fitted experiments state; nullopt if they state none.
std::optional<MeasurementNoise> typical_noise(const Study& study);

/// Returns the gains of repeating every fitted experiment and each of its values, most useful
/// first. The list is empty if the spread of the values is not known.
std::vector<MeasurementGain> repetition_gains(const Study& study, const Identifiability& what);

/// Returns the points at which the predicted experiments have to be simulated: the point itself and
/// one step along every variable. A step is as long as the one over which that variable's
/// derivative was computed, which noise and ripple of the fitted experiments decided.
std::vector<DesignPoint> prediction_points(const Study& study, const Identifiability& what);

/// Returns the gains of every experiment with use = "predict", and of every test that has several
/// of them as a whole, most useful first. `at_points` are the channels of all experiments at
/// prediction_points(study, what).
std::vector<MeasurementGain> prediction_gains(const Study& study,
                                              const Identifiability& what,
                                              const std::vector<Channels>& at_points);

}  // namespace latsch::correlation
