// SPDX-License-Identifier: Apache-2.0
// What a fit says against its own model: errors beyond what noise and the uncertainty of its
// variables explain.
//
// Held out: every fitted experiment g is left out in turn and predicted by the others, to first
// order of the residuals r (in units of their noise, J their slopes, s their spread),
//   M = J_-g' J_-g + 12 s^2 I,   e = r_g - J_g M^-1 J_-g' r_-g,
//   chi^2 = e' (s^2 I + s^2 J_g M^-1 J_g')^-1 e
// and the experiments with use = "predict" add their chi^2 about their bands (prediction_bands.h),
// where these are known. Over the number of values that is 1 of a right model; more than chance has
// once in a thousand is what its numbers are more uncertain by than the fit says.
//
// Spectrum: of experiments over time (curve.h: values, about_mean) with a stated noise,
//   D = ln S_mea / (S_sim + N),   v = (2 S_sim N + N^2)/(K (S_sim + N)^2) + sum_k g_k^2
// line by line, N the density of the noise, K segments averaged, g_k what the fit's own
// uncertainty moves the line by. In third-octave bands where  mean D^2 > v  beyond chance,
//   delta^2 = mean (D^2 - v)
// is the variance of the logarithm of a density the model gets wrong whatever its numbers are. A
// comparison takes it for that of the densities it predicts at the same frequency: a guess, since
// the road and what lies between are others, but of the measured size. It is constant beyond the
// outermost bands, and linear in ln f between their centers.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "correlation/analysis/identifiability.h"
#include "numerics/signals/welch.h"

namespace latsch::correlation {

/// Of ln S over frequency; empty: no experiment tells.
struct SpectralDiscrepancy {
  std::vector<double> frequency;  // Hz, centers of the bands, rising
  std::vector<double> deviation;  // delta

  double at(double f) const;  // 0 where empty
};

/// The root of chi^2 over the number of values, where that cannot be chance; else 1.
double held_out_error(const Study& study, const Identifiability& what, const Journal& journal);

/// Spectra of segments so long, s; `axes`: independent deviations of the variables.
SpectralDiscrepancy spectral_discrepancy(const Study& study,
                                         const Identifiability& what,
                                         const Eigen::MatrixXd& axes,
                                         double segment);

/// How many independent spectra an average of Welch's segments is worth.
double independent_segments(int samples, const numerics::WelchSettings& settings);

}  // namespace latsch::correlation
