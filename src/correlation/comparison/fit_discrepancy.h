// SPDX-License-Identifier: Apache-2.0
// Model errors that a fit reveals: errors beyond what noise and the uncertainty of its variables
// explain.
//
// Held-out error: every fitted experiment g is left out in turn and predicted from the others, to
// first order of the residuals r (in units of their noise, with J their slopes and s their spread):
//   M = J_-g' J_-g + 12 s^2 I,   e = r_g - J_g M^-1 J_-g' r_-g,
//   chi^2 = e' (s^2 I + s^2 J_g M^-1 J_g')^-1 e
// Experiments with use = "predict" add their chi^2 about their bands (prediction_bands.h), if these
// are known. Chi^2 over the number of values is 1 for a correct model. If it is larger than chance
// makes it once in a thousand, it measures how much more uncertain the model's numbers are than the
// fit says.
//
// Spectral discrepancy: for experiments over time (curve.h: values, about_mean) with stated noise,
// each line of the spectrum gives
//   D = ln S_mea / (S_sim + N),   v = (2 S_sim N + N^2)/(K (S_sim + N)^2) + sum_k g_k^2
// with N the density of the noise, K the number of averaged segments and g_k the change of the line
// by the fit's own uncertainty. In third-octave bands in which mean D^2 exceeds v beyond chance,
//   delta^2 = mean (D^2 - v)
// is the variance of the logarithm of a density that the model gets wrong whatever its numbers are.
// A comparison uses delta for the densities it predicts at the same frequency. That is a guess,
// because road and transmission differ, but its size is measured. Delta is constant beyond the
// outermost bands and linear in ln f between their centers.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "correlation/analysis/identifiability.h"
#include "numerics/signals/welch.h"

namespace latsch::correlation {

/// Discrepancy of the logarithm of the spectral density S over frequency. It is empty if no
/// experiment determines it.
struct SpectralDiscrepancy {
  std::vector<double> frequency;  // Hz, centers of the bands, rising
  std::vector<double> deviation;  // delta, standard deviation of ln S

  double at(double f) const;  // 0 if empty
};

/// Returns the root of chi^2 over the number of values if that cannot be chance; otherwise 1.
double held_out_error(const Study& study, const Identifiability& what, const Journal& journal);

/// Computes the discrepancy from spectra with segments of this length, s. `axes` are independent
/// deviations of the variables.
SpectralDiscrepancy spectral_discrepancy(const Study& study,
                                         const Identifiability& what,
                                         const Eigen::MatrixXd& axes,
                                         double segment);

/// Returns the number of independent spectra whose average has the same variance as the average
/// over Welch's segments.
double independent_segments(int samples, const numerics::WelchSettings& settings);

}  // namespace latsch::correlation
