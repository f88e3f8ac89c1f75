// SPDX-License-Identifier: Apache-2.0
// Solves for the nuisance numbers z of one recording, and removes from residuals and slopes what
// these numbers explain [variable projection: G. Golub, V. Pereyra, SIAM Journal on Numerical
// Analysis 10 (1973) 413; slopes: L. Kaufman, BIT 15 (1975) 49].
//
// The weighted residuals of a recording are r + A z in linear approximation, and a prior of mean 0
// and deviation sigma_k adds the residual z_k / sigma_k. With B = [A; S^-1/2], S = diag(sigma^2),
//   z = -(B'B)^-1 A' r              least sum of squares
//   dz/dp = -(B'B)^-1 A' J          J = dr/dp at constant z
//   J - A (A'A + S^-1)^-1 A'J       projected slopes; those of the priors are (dz/dp)_k / sigma_k
// All are computed from an orthogonal basis of B (Gram-Schmidt, twice), never from B'B.
//
// A column that the columns before it explain to kDependent belongs to a number that the recording
// does not determine. Its z is 0.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace latsch::correlation {

class NuisanceProjection {
 public:
  /// Takes A, m x k, and the k deviations of the priors; infinite: none.
  NuisanceProjection(const Eigen::MatrixXd& A, const Eigen::VectorXd& sigma);

  /// Returns the change dz that minimizes |r + A dz|^2 + |(z + dz) / sigma|^2.
  Eigen::VectorXd step(const Eigen::VectorXd& r, const Eigen::VectorXd& z) const;
  /// Returns dz/dp for the slopes J at constant z; k x n.
  Eigen::MatrixXd following(const Eigen::MatrixXd& J) const;
  /// Returns the covariance of z at constant p for residuals of deviation 1; 0 for numbers that are
  /// not determined.
  Eigen::MatrixXd covariance() const;
  /// Returns the standard deviations of z, the roots of the covariance's diagonal.
  Eigen::VectorXd deviations() const { return covariance().diagonal().cwiseSqrt(); }
  /// True if the recording, or its prior, determines number k beside those before it.
  bool determines(Eigen::Index k) const { return place_[static_cast<std::size_t>(k)] >= 0; }

 private:
  Eigen::MatrixXd solved(const Eigen::MatrixXd& right) const;

  Eigen::Index rows_, numbers_;
  Eigen::VectorXd sigma_;
  Eigen::MatrixXd Q_, R_;             // B = Q R for the columns that are determined
  std::vector<Eigen::Index> place_;   // column of Q of each number; -1: not determined
  std::vector<Eigen::Index> number_;  // number of each column of Q
};

}  // namespace latsch::correlation
