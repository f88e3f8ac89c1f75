// SPDX-License-Identifier: Apache-2.0
// Which measurement would tell the most about the variables: d_optimality.h over the experiments
// of a study.
//
// Two kinds of candidates. A measured value made once more costs no simulation: its derivatives are
// known. An experiment with use = "predict" has not been fitted; its derivatives need its
// simulation at the points of the differences. A candidate's values are taken to be as exact as its
// stated noise, or as the fitted values are.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "correlation/analysis/identifiability.h"

namespace latsch::correlation {

struct MeasurementGain {
  std::string measurement;  // "modes once more", "stiffness at 20 mm once more", "footprint"
  double shrinkage = 1.0;   // of the volume of the confidence region
  int helps = 0;            // the variable whose deviation falls by the largest factor
  double before = 0.0, after = 0.0;  // its standard deviation, in ranges
};

/// Mean of the noise that the values of the fitted experiments state, relative; nullopt where they
/// do not.
std::optional<MeasurementNoise> typical_noise(const Study& study);

/// Every fitted experiment, and each of its values, measured once more; most useful first. Empty
/// where the spread of the values is not known.
std::vector<MeasurementGain> repetition_gains(const Study& study, const Identifiability& what);

/// Where the predicted experiments are to be simulated: the point and a step along every variable,
/// each as long as that variable's derivative was taken over, which noise and ripple of the fitted
/// experiments decided.
std::vector<DesignPoint> prediction_points(const Study& study, const Identifiability& what);

/// Every experiment with use = "predict", from the channels of all experiments at
/// prediction_points(study, what), and every test that has several of them as a whole; most useful
/// first.
std::vector<MeasurementGain> prediction_gains(const Study& study,
                                              const Identifiability& what,
                                              const std::vector<Channels>& at_points);

}  // namespace latsch::correlation
