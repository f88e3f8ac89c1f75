// SPDX-License-Identifier: Apache-2.0
// Estimates the noise of residuals from the residuals of a fit: its size, and how much of it
// neighboring samples of a measured curve share.
//
// A curve sampled twice as densely has twice as many samples but almost no more information if its
// noise is slow. The residuals of one curve, in the order of its samples, are modeled as an
// autoregression (numerics/signals/autoregression.h) of an order up to kMostOrder; residuals
// without a curve are independent. D holds the stated deviations of the residuals relative to each
// other, R is the correlation matrix, r = D x and J = D G. The correlations maximize the likelihood
// of the part of r that the fit cannot change,
//   -2 l = ln|R| + ln|G' R^-1 G| + (m - k) ln(x' P x),   P = R^-1 - R^-1 G (G' R^-1 G)^-1 G' R^-1
// with k columns of G, a basis of the changes that variables and solved unknowns cause: variables
// without an effect, or with that of others, do not count. This is the restricted likelihood
// [Patterson, Thompson, Biometrika 58 (1971) 545]. It accounts for the fact that a fit follows its
// noise, so that the residuals look less correlated than the noise is. The order is the one with
// the least -2 l + 2 p [Akaike, IEEE Trans. Automat. Contr. 19 (1974) 716].
//
// Exact values beside a few wrong ones, as after a fit with a robust loss, count as white, too.
//
// The deviation of the noise is at most three times the spread that the residuals show, and an
// interval has at least two degrees of freedom: without these limits noise that a fit could have
// hidden made many intervals infinite, which contained the truth no more often.
//
// Limits: all curves without groups have one spread in units of their deviations. If a curve has
// much less noise than another, it counts as slow noise of this spread, and intervals are too wide;
// estimated noise of the experiments avoids it. Neighbors count as equally far apart, and a curve
// with fewer than kFewestSamples samples beyond the number of variables counts as white. Deviations
// that a model cannot reproduce look like slow noise. If they are smooth along their curves, they
// are recognized as a pattern: an autoregression would take them for noise so slow that its level
// may be any number, and every variable would be free. Noise stronger than a tenth of a pattern
// hides it, and then it counts as noise.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "numerics/signals/autoregression.h"
#include "optimization/identifiability/group_spreads.h"
#include "optimization/identifiability/robust_loss.h"

namespace latsch {

/// Traits of the residuals: the standard deviation of each in units of sigma; the curve of which it
/// is a sample, with neighboring samples in successive rows; and its robust loss. Empty lists mean
/// that all deviations are 1, all residuals are independent, none has a loss, and all share one
/// spread.
struct ResidualTraits {
  std::vector<double> deviations = {};
  std::vector<int> curves = {};         // < 0: independent
  std::vector<RobustLoss> losses = {};  // scales of the losses are in the unit of the residuals
  /// For each unknown that was solved at every point and removed from residuals and derivatives,
  /// the changes of the residuals by it, in any scale. Each leaves one degree of freedom less.
  std::vector<Eigen::VectorXd> solved = {};
  /// Group of each residual; every group has a spread of its own, which is estimated
  /// (group_spreads.h). < 0: its deviation is known. Fewer than two groups count as none, and so do
  /// all groups beside a robust loss, whose spreads follow from the values within its corner.
  std::vector<int> groups = {};

  /// Returns the traits of some of the residuals.
  ResidualTraits of(const std::vector<Eigen::Index>& rows) const;
};

class ResidualNoise {
 public:
  /// Takes the residuals r at a fit and their derivatives J with respect to all variables that
  /// might explain them. A spread at or below `least_seen` counts as rounding errors of the
  /// simulations and not as noise, so no correlation is estimated. Rounding errors have no pattern
  /// from sample to sample: an autoregression may fit them as well as a constant does, which would
  /// leave no independent sample.
  ResidualNoise(const Eigen::VectorXd& r,
                const Eigen::MatrixXd& J,
                const ResidualTraits& traits,
                double least_seen = 0.0);

  /// Standard deviation of a residual whose own deviation is 1; NaN if no residual is left to
  /// estimate it from.
  double sigma() const { return sigma_; }
  /// Number of residuals minus the number of independent changes that the variables and the solved
  /// unknowns cause. Variables without an effect leave it unchanged.
  double freedom() const { return freedom_; }
  bool is_white() const;
  /// True if the residuals vary smoothly along their curves, as the misfit of a model does and
  /// noise does not, or if they were taken for such a pattern. Their deviation is then at most
  /// twice the spread that they show.
  bool is_pattern() const { return is_pattern_; }
  /// Takes residuals whose neighbors are correlated for a misfit of the model, because something
  /// else than their shape shows that they are no noise.
  void take_for_pattern();

  /// True if groups of residuals have spreads of their own.
  bool has_groups() const { return !groups_.empty(); }
  const GroupSpreads& groups() const { return groups_; }

  /// Scales the columns of Y so that the squared norm of a column y becomes  y' D R D y,  the
  /// variance of y' r in units of sigma^2.
  Eigen::MatrixXd colored(const Eigen::MatrixXd& Y) const;
  /// Returns  Y' D R D Y, the covariance of Y' r in units of sigma^2, and what estimated spreads
  /// of groups add to it.
  Eigen::MatrixXd covariance(const Eigen::MatrixXd& Y) const;
  /// Returns the columns of Y with uncorrelated rows of deviation 1: if y has the covariance D R D
  /// sigma^2, its column has the covariance sigma^2.
  Eigen::MatrixXd whitened(const Eigen::MatrixXd& Y) const;
  /// Returns the columns that whitened() turns into those of Z.
  Eigen::MatrixXd unwhitened(const Eigen::MatrixXd& Z) const;
  /// Returns for every residual its deviation, in units of sigma, times the square root of the
  /// number of neighboring samples that together hold as much information as one independent
  /// sample.
  Eigen::VectorXd effective_deviations() const;

  /// Returns how many neighboring samples of the curves whose neighbors are correlated hold as much
  /// information as one independent sample, in the mean over these; below 1 if neighbors scatter to
  /// opposite sides. 1 if there are none.
  double samples_for_one() const;

  /// Returns the degrees of freedom of an estimated variance  c sigma^2 |colored(Y)|^2
  /// [Satterthwaite, Biometrics Bulletin 2 (1946) 110]. There are fewer if the correlations or the
  /// spreads of groups are uncertain, too. `known` is true if sigma is known.
  double freedom_of(const Eigen::VectorXd& y, bool known) const;

 private:
  struct Curve {
    std::vector<Eigen::Index> rows;
    numerics::Autoregression process;
    Eigen::MatrixXd variance;  // covariance of the z = atanh(kappa)
  };
  struct Sums {  // sums over the whitened rows of a curve
    Eigen::MatrixXd A;
    Eigen::VectorXd b;
    double c = 0.0, log_determinant = 0.0;
  };

  Sums sums(const Curve& curve, const numerics::Autoregression& process) const;
  double deviance(const Sums& all) const;
  double deviance_with(const Sums& rest, const Curve& curve, const std::vector<double>& z) const;
  double sigma_of(const Sums& all) const;
  bool forms_pattern() const;
  void fit(Curve& curve, const Sums& rest) const;
  double log_variance(const Eigen::VectorXd& y,
                      size_t curve,
                      const std::vector<double>& z,
                      const Sums& rest,
                      bool known) const;

  GroupSpreads groups_;
  Eigen::VectorXd deviations_, x_;
  Eigen::MatrixXd Q_;  // orthonormal columns that span G
  double freedom_ = 0.0, sigma_ = 0.0;
  double seen_ = 0.0;  // spread of the residuals if they are independent
  bool is_pattern_ = false;
  std::vector<Curve> curves_;  // all curves, including those whose noise turns out to be white
  std::vector<Eigen::Index> alone_;
  Sums alone_sums_;
  std::vector<Sums> curve_sums_;
};

}  // namespace latsch
