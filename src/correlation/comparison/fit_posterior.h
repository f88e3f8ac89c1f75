// SPDX-License-Identifier: Apache-2.0
// Uncertainty that a fit leaves in the numbers of its model. It is read from the journal of a study
// that `latsch run` has completed, for the bands of a comparison of models.
//
// With the letters of optimization/identifiability/confidence.h and u the variables in the unit
// cube at the end of the fit,
//   C = s^2 (J'J)^-1 J'VJ (J'J)^-1        as for the fit's own intervals; s is the spread seen if
//                                         residuals exceed their stated noise
//   P = (C^-1 / K + 12 I)^-1 = sum a_k a_k'     12 I: the bounds, as a uniform distribution
//   K = max(1, squared error of held-out values)                        (fit_discrepancy.h)
// The a_k are independent directions of one standard deviation each, correlations included. Three
// more kinds of directions are added: for a variable held at its bound, inward by its interval over
// t, with the others following by their refit; the remaining distance of a search that ended early;
// and the distance to the refined model, if the study has one.
//
// Limits: the posterior is linear about the point. A direction that the data leave open is as wide
// as the bounds of the study, so choose these as what is known without the fit.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "correlation/comparison/fit_discrepancy.h"
#include "correlation/study/study.h"

namespace latsch::correlation {

/// Table [fit.NAME] of a comparison.
struct FitSource {
  std::string name;
  std::shared_ptr<const Study> study;
  /// Prefixes of the paths at which the compared models contain the model of the fit; "" stands for
  /// the whole model.
  std::vector<std::string> at;
  Place place = {};
  bool has_bands = true;  // false: the best point alone is used, without its uncertainty
};

struct FitPosterior {
  std::string name;
  DesignPoint point;     // best trial of the fit
  Eigen::MatrixXd axes;  // n x k, columns in the unit cube
  double excess = 1.0;  // ratio of the residuals to their stated noise; the axes already contain it
  /// Ratio of the errors of held-out values to those that noise and variables explain; the axes
  /// already contain it.
  double held_out = 1.0;
  SpectralDiscrepancy discrepancy;
  std::vector<std::string> remarks;  // remarks about the fit's own intervals
};

/// Throws InputError if the journal does not contain the fit; the message names the command to run.
FitPosterior fit_posterior(const FitSource& source, double segment);

/// Returns the paths in the compared model that belong to a variable of the fit.
std::vector<std::string> paths_of(const FitSource& source, const DesignVariable& variable);
/// Throws InputError if a variable of the fit is no parameter of the model or has another unit.
void check_fit(const FitSource& source, const Document& model, const std::string& title);
/// Sets the fit's variables in the model to the values at u in the unit cube; u is clamped to the
/// cube.
void move_to(const FitSource& source, const std::vector<double>& u, Document& model);

}  // namespace latsch::correlation
