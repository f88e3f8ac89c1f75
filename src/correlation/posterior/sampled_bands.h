// SPDX-License-Identifier: Apache-2.0
// 95 % bands of the computed values of every fitted experiment from samples of the variables'
// posterior density, beside the linear bands of prediction_bands.h.
//
// No trial is run: the surrogate predicts the residuals of every sample. With d the difference that
// a residual stands for, the computed value is
//   y = measured - scale d,   y = measured (1 - d)^2 if roots of forces are compared
// with the nuisance numbers of the recording applied. The band is the 2.5, 50 and 97.5 % points of
// y at each measured value by itself.
//
// Limits: experiments that are only predicted have no residuals, so they have only linear bands.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "correlation/study/study.h"

namespace latsch::correlation {

/// Band of one experiment: one value for each row of its observable, in its SI unit.
struct SampledBand {
  int experiment = 0;  // index in the study
  std::vector<double> lower, median, upper;
};

/// Returns one band for every experiment that has rows. `rows` are indices among all residuals of
/// residual_objective(), and `residuals` the residuals of these rows, one column for each sample.
std::vector<SampledBand> sampled_bands(const Study& study,
                                       const std::vector<Eigen::Index>& rows,
                                       const Eigen::MatrixXd& residuals);

}  // namespace latsch::correlation
