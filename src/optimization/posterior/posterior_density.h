// SPDX-License-Identifier: Apache-2.0
// The logarithm of the posterior density of the variables, up to a constant.
//
// The residuals r of m measured values are whitened: their noise has the covariance s^2 1. With the
// sum of squares S = r'r and a prior density p(u) inside the bounds,
//
//   ln p(u | data) = -S / (2 s^2) + ln p(u)             if s is stated                         (1)
//   ln p(u | data) = -(m / 2) ln S + ln p(u)            if s is unknown                        (2)
//
// (2) is the integral over s with its density 1/s [Box, Tiao, Bayesian Inference in Statistical
// Analysis, 1973, ch. 2.4]. A model that is linear then has Student's distribution with m - n
// degrees of freedom, as its intervals have. The density is uniform in the unit cube where no prior
// is stated, so that it is uniform in the logarithm of a logarithmic variable.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <optional>

namespace latsch {

constexpr double kNoDensity = -std::numeric_limits<double>::infinity();

/// Logarithm of a density at a point of the unit cube; kNoDensity where the density is 0.
using LogDensityAt = std::function<double(const Eigen::VectorXd& u)>;

/// Coordinates q(u), as many as variables, in which a curved valley of a density is straight. Empty
/// functions: there are none.
struct Straightening {
  std::function<Eigen::VectorXd(const Eigen::VectorXd& u)> coordinates;  // q, n
  std::function<Eigen::MatrixXd(const Eigen::VectorXd& u)> slopes;       // dq/du, n x n

  explicit operator bool() const { return coordinates && slopes; }
};

struct PosteriorDensity {
  std::optional<double> s = 1.0;  // deviation of a whitened residual; nullopt: unknown
  Eigen::Index values = 0;        // m, without the rows of priors
  /// Returns ln p(u); kNoDensity where constraints exclude the point. It need not check the bounds.
  /// Empty: uniform.
  LogDensityAt log_prior = {};

  /// Returns the logarithm of the density for the sum of squares S at u.
  double at(double S, const Eigen::VectorXd& u) const;
};

}  // namespace latsch
