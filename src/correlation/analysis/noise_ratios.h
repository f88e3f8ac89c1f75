// SPDX-License-Identifier: Apache-2.0
// Compares the residuals of a fit with their stated noise, for each experiment and for priors that
// the data contradict: which noise is stated wrongly?
#pragma once

#include <string>
#include <vector>

#include "correlation/study/study.h"
#include "optimization/identifiability/identification.h"

namespace latsch::correlation {

/// Residuals of an experiment, or the one of a prior, beside their stated noise.
struct NoiseRatio {
  std::string name;
  double ratio = 0.0;   // root mean square over the stated noise
  double values = 0.0;  // their number
};

/// Returns the ratios of the experiments and of priors that are missed by more than three
/// deviations, the largest first; empty if rows belong to several experiments.
std::vector<NoiseRatio> noise_ratios(const Study& study, const Identification& identification);

/// Returns for example " (by source force 9.1, modes 0.97)"; empty if there is one experiment.
std::string in_words(const std::vector<NoiseRatio>& ratios);

/// Returns a sentence on experiments whose residuals are so far below their stated noise that
/// chance does not explain it; empty if there is none.
std::string large_noise_in_words(const Study& study, const std::vector<NoiseRatio>& ratios);

/// Returns a sentence on experiments that share one spread, because none states its noise, although
/// their residuals scatter differently beyond chance; empty if there are none.
std::string unlike_spreads_in_words(const Study& study, const Identification& identification);

/// Returns a sentence on experiments whose noise is estimated from hardly any value beyond those
/// that the fit uses up; empty if there is none.
std::string scarce_estimates_in_words(const Study& study, const Confidence& c);

}  // namespace latsch::correlation
