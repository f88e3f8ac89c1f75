// SPDX-License-Identifier: Apache-2.0
// What a fit leaves open of the numbers of a model that comes from it: a study that `latsch run`
// has ended, read from its journal, for the bands of a comparison of models.
//
// With the letters of optimization/identifiability/confidence.h, u the variables in the unit cube
// at the end of the fit,
//   C = s^2 (J'J)^-1 J'VJ (J'J)^-1        as the fit's own intervals have it: s is the spread seen,
//                                         where residuals exceed their stated noise
//   P = (C^-1 / K + 12 I)^-1 = sum a_k a_k'     12 I: what the bounds say of a uniform number
//   K = max(1, what the fit misses held-out values by, squared)         (fit_discrepancy.h)
// a_k are independent directions of one standard deviation each, correlations included. Three more
// kinds of directions: a variable held at its bound, inward as far as its interval reaches over t,
// the others following by their refit; what a search that ended early has left of its way; and the
// way to the refined model, where the study has one.
//
// Limits: linear about the point. A direction that the data leave open is as wide as the bounds of
// the study: choose these as what is known without the fit.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "correlation/comparison/fit_discrepancy.h"
#include "correlation/study/study.h"

namespace latsch::correlation {

/// [fit.NAME] of a comparison.
struct FitSource {
  std::string name;
  std::shared_ptr<const Study> study;
  std::vector<std::string> at;  // where its model stands in those compared; "": it is them
  Place place = {};
};

struct FitPosterior {
  std::string name;
  DesignPoint point;      // where the fit has ended: its best trial
  Eigen::MatrixXd axes;   // n x k, of the unit cube
  double excess = 1.0;    // of the residuals over their stated noise; in the axes
  double held_out = 1.0;  // of held-out values over what noise and variables explain; in the axes
  SpectralDiscrepancy discrepancy;
  std::vector<std::string> remarks;  // of the fit's own intervals
};

/// Throws InputError naming what to run where the journal does not tell it.
FitPosterior fit_posterior(const FitSource& source, double segment);

/// Paths in the model of a comparison that a variable of the fit moves.
std::vector<std::string> paths_of(const FitSource& source, const DesignVariable& variable);
/// Throws InputError where a variable of the fit is no number of the model, or of another unit.
void check_fit(const FitSource& source, const Document& model, const std::string& title);
/// The model with the fit's variables at a place of the unit cube, clamped to it.
void move_to(const FitSource& source, const std::vector<double>& u, Document& model);

}  // namespace latsch::correlation
