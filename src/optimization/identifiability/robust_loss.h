// SPDX-License-Identifier: Apache-2.0
// Robust losses reduce the weight of values with large errors in a fit.
//
// With x the error of a value, c the scale of the loss and z = (x / c)^2, the residual of a
// least-squares method is
//   r = sign(x) c sqrt(rho(z)),    whose square is c^2 rho(z):
//   huber    rho = z  up to 1, then  2 sqrt(z) - 1    [Huber, Ann. Math. Statist. 35 (1964) 73]
//   cauchy   rho = ln(1 + z)
// In the letters of M-estimation, which minimizes the sum of r^2 / 2,
//   psi = d(r^2 / 2)/dx = r dr/dx:
//   huber    psi = x  up to the corner c, then  sign(x) c;    psi' = 1, then 0
//   cauchy   psi = x / (1 + z);                               psi' = (1 - z) / (1 + z)^2
// [Huber, Robust Statistics, 1981, ch. 4 and 7]. A value beyond the corner, |x| > c, has a psi that
// no longer grows with x.
#pragma once

namespace latsch {

enum class Loss { squares, huber, cauchy };

/// The quantities of M-estimation for one residual.
struct LimitedResidual {
  double psi = 0.0;        // psi, in the unit of the residual
  double slope = 1.0;      // slope dr/dx of the loss, in (0, 1]
  double psi_slope = 1.0;  // psi'
  bool is_beyond = false;  // |x| > c
};

/// Expected values of the quantities of M-estimation for Gaussian errors x.
struct GaussianLoss {
  double inside = 1.0;     // mean psi^2 of the values inside the corner
  double psi_slope = 1.0;  // mean psi' of all values
  double beyond = 0.0;     // share of the values beyond the corner
};

struct RobustLoss {
  Loss loss = Loss::squares;
  double scale = 1.0;  // scale c of the loss, in the unit of x

  bool operator==(const RobustLoss&) const = default;

  /// Returns the residual r of the error x.
  double operator()(double x) const;
  /// Returns dr/dx.
  double slope(double x) const;
  /// Returns the quantities of M-estimation for the residual r, from which its error x follows.
  LimitedResidual at(double r) const;
  /// Returns the expected values for Gaussian x of mean 0 and standard deviation sigma; psi^2 is in
  /// units of sigma^2.
  GaussianLoss expected(double sigma) const;
};

}  // namespace latsch
