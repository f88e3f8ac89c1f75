// SPDX-License-Identifier: Apache-2.0
// A sparse polynomial of a response over the unit cube, fitted to scattered points: a polynomial
// chaos expansion [G. Blatman, B. Sudret, J. Comput. Phys. 230 (2011) 2345].
//
//   y(u) = sum over a of c_a  product over i of P_a_i(u_i)                             (1)
//
// with the Legendre polynomials P_k that are orthonormal over 0 .. 1. Candidates a have at most
// three variables and sum over i of a_i^q <= p^q; p is 1, 2, 3, ... and q is 1/2, 3/4 or 1. Terms
// are taken one after the other, always the one that reduces the sum of squares the most. How many
// of them, and which p and q, is decided by cross-validation over five parts of the points, in each
// of which the terms are chosen anew: the error of the points that a choice has seen would favor
// too many terms.
//
// Limits: jumps and kinks need many terms and are met badly by few points. About ten points for
// each variable that matters are the least that is worth a fit.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace latsch {

class PolynomialChaos {
 public:
  struct Term {
    std::vector<int> degrees;  // a, one for each variable
    double coefficient = 0.0;  // c_a
  };

  /// Fits the polynomial to the values (N) at the points (N x n, in the unit cube). Requires two
  /// points at least. Equal arguments give the same bits.
  PolynomialChaos(const Eigen::MatrixXd& points, const Eigen::VectorXd& values);

  /// Returns y at a point (n) of the unit cube.
  double value(const Eigen::VectorXd& point) const;
  /// Terms in the order in which they were taken; the first is the constant.
  const std::vector<Term>& terms() const { return terms_; }
  /// Variance of y over the cube: the sum of the squares of all coefficients but the constant's.
  double variance() const;
  /// Returns the part of the variance by terms that contain variable i and no other (`alone`), or
  /// that contain it at all.
  double variance_of(int i, bool alone) const;

 private:
  std::vector<Term> terms_;
};

}  // namespace latsch
