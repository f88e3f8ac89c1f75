// SPDX-License-Identifier: Apache-2.0
// The noise of residuals, estimated from what a fit leaves: its size, and how much of it
// neighboring samples of a measured curve share.
//
// A curve that is sampled twice as densely has twice as many samples and next to no more to tell
// where its noise is slow. Residuals of one curve, in the order of its samples, are taken for an
// autoregression (numerics/signals/autoregression.h) of an order up to kMostOrder, of those without
// a curve each is alone. With D the stated deviations of the residuals in units of each other, R
// the correlation matrix, r = D x and J = D G, the correlations are those of the greatest
// likelihood of what the fit cannot reach,
//   -2 l = ln|R| + ln|G' R^-1 G| + (m - n) ln(x' P x),   P = R^-1 - R^-1 G (G' R^-1 G)^-1 G' R^-1
// the restricted likelihood [Patterson, Thompson, Biometrika 58 (1971) 545], which does not mistake
// for whiteness that a fit bends towards its noise. The order is the one of least -2 l + 2 p
// [Akaike, IEEE Trans. Automat. Contr. 19 (1974) 716].
//
// Limits: neighbors count as equally far apart, and a curve of fewer than kFewestSamples beyond the
// variables as white. What a model cannot follow looks like slow noise, and is told as such.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "numerics/signals/autoregression.h"

namespace latsch {

/// Of every residual: its deviation in units of sigma, and the curve it is a sample of, neighbors
/// side by side. Empty: all 1, and all alone.
struct ResidualTraits {
  std::vector<double> deviations = {};
  std::vector<int> curves = {};  // < 0: alone

  /// Of some of the residuals.
  ResidualTraits of(const std::vector<Eigen::Index>& rows) const;
};

class ResidualNoise {
 public:
  /// From the residuals r at a fit and J of all that might explain them.
  /// `least_seen`: a spread of the residuals at or below it is rounding of the simulations and no
  /// noise, so no correlation is looked for in it. Rounding repeats from sample to sample as it
  /// likes: an autoregression of it may be as good as a constant, and leaves nothing known.
  ResidualNoise(const Eigen::VectorXd& r,
                const Eigen::MatrixXd& J,
                const ResidualTraits& traits,
                double least_seen = 0.0);

  /// Standard deviation of a residual of deviation 1; NaN where nothing is left to estimate it
  /// from.
  double sigma() const { return sigma_; }
  /// Residuals less the variables they determine.
  double freedom() const { return freedom_; }
  bool is_white() const;

  /// The squared norm of a column y is  y' D R D y,  the variance of y' r in units of sigma^2.
  Eigen::MatrixXd colored(const Eigen::MatrixXd& Y) const;
  /// Of every residual, in units of sigma: its deviation times the root of how many of its
  /// neighbors tell as much as one alone.
  Eigen::VectorXd effective_deviations() const;

  /// Degrees of freedom of an estimated variance  c sigma^2 |colored(Y)|^2,  [Satterthwaite,
  /// Biometrics Bulletin 2 (1946) 110]: fewer where the correlations are uncertain too. `known`:
  /// sigma is.
  double freedom_of(const Eigen::VectorXd& y, bool known) const;

 private:
  struct Curve {
    std::vector<Eigen::Index> rows;
    numerics::Autoregression process;
    Eigen::MatrixXd variance;  // of atanh(kappa)
  };
  struct Sums {  // over the rows of a curve, white
    Eigen::MatrixXd A;
    Eigen::VectorXd b;
    double c = 0.0, log_determinant = 0.0;
  };

  Sums sums(const Curve& curve, const numerics::Autoregression& process) const;
  double deviance(const Sums& all) const;
  double deviance_with(const Sums& rest, const Curve& curve, const std::vector<double>& z) const;
  double sigma_of(const Sums& all) const;
  void fit(Curve& curve, const Sums& rest) const;
  double log_variance(const Eigen::VectorXd& y,
                      size_t curve,
                      const std::vector<double>& z,
                      const Sums& rest,
                      bool known) const;

  Eigen::VectorXd deviations_, x_;
  Eigen::MatrixXd Q_;  // orthonormal columns that span G
  double freedom_ = 0.0, sigma_ = 0.0;
  std::vector<Curve> curves_;  // also those that turn out white
  std::vector<Eigen::Index> alone_;
  Sums alone_sums_;
  std::vector<Sums> curve_sums_;
};

}  // namespace latsch
