// SPDX-License-Identifier: Apache-2.0
// A quadratic model of the evaluated points nearest to a center, and its minimum in a ball.
//
//   m(s) = c + g' s + 1/2 s' H s
//
// The model is fitted by weighted linear least squares, in which near points count most. If there
// are fewer points than coefficients, the model with the smallest H is chosen.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "optimization/problem/shared_history.h"

namespace latsch {

struct Sample {
  Eigen::VectorXd u;
  double value;
};

struct QuadraticModel {
  Eigen::VectorXd g;
  Eigen::MatrixXd H;
  /// Share of the samples' variance that the model leaves unexplained; 0 if it has as many
  /// coefficients as samples.
  double misfit;
};

/// Returns the samples nearest to `center`, as many as a model uses.
std::vector<Sample> nearest_samples(const SharedHistory<Sample>& samples,
                                    const Eigen::VectorXd& center);

/// Fits a model to samples ordered nearest first. `radius` is the length by which distances are
/// scaled. Returns nullopt with fewer than n + 2 samples.
std::optional<QuadraticModel> fit_quadratic(const std::vector<Sample>& chosen,
                                            const Eigen::VectorXd& center,
                                            double radius);

struct BallStep {
  Eigen::VectorXd s;
  double mu;
};

/// Returns the step s, |s| <= radius, with the least m(s). It solves  (H + mu I) s = -g, mu >= 0,
/// with the eigenvectors of H. [Moré, Sorensen, SIAM J. Sci. Stat. Comput. 4 (1983) 553]
BallStep minimize_in_ball(const QuadraticModel& model, double radius);

}  // namespace latsch
