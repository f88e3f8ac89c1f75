// SPDX-License-Identifier: Apache-2.0
// Shift-invert Lanczos method for the lowest eigenvalues of K x = lambda M x, with full
// reorthogonalization in the M-inner product and thick restart.
//
// The operator (K - sigma M)^-1 M is self-adjoint in the M-inner product; its largest eigenvalues
// theta give lambda = sigma + 1 / theta. A block of start vectors finds multiplicities up to the
// block size. Further copies appear only by rounding, so the block must not be smaller than the
// largest multiplicity.
// [Wu & Simon, Thick-restart Lanczos method for large symmetric eigenvalue problems,
//  SIAM J. Matrix Anal. Appl. 22 (2000)]
// [Grimes, Lewis & Simon, A shifted block Lanczos algorithm for solving sparse symmetric
//  generalized eigenproblems, SIAM J. Matrix Anal. Appl. 15 (1994)]
#pragma once

#include <Eigen/Core>
#include <complex>
#include <functional>

namespace latsch::numerics {

/// Eigenvalue problem. Scalar is double, or std::complex<double> for Hermitian K and M.
template <class Scalar>
struct EigenProblem {
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  int size = 0;
  double shift = 0.0;                               // shift sigma, below the wanted eigenvalues
  std::function<void(Eigen::Ref<Matrix> X)> solve;  // X <- (K - sigma M)^-1 X
  std::function<void(const Eigen::Ref<const Matrix>& X, Eigen::Ref<Matrix> Y)> mass;  // Y = M X
};

struct LanczosSettings {
  int count = 20;  // number of wanted eigenpairs
  /// Residual of the inverted problem relative to theta. The relative error of theta is the square
  /// of this residual divided by the relative gap to the next theta.
  double tolerance = 1e-8;
  /// Number of last wanted pairs to which spare_tolerance applies.
  int spare = 0;
  double spare_tolerance = 0.0;
  /// Number of vectors multiplied per step. 1 suits simple spectra, and 2 finds both members of a
  /// pair of equal eigenvalues. With a sparse factor 3 to 5 are fastest, because several right-hand
  /// sides are solved together at less cost.
  int block = 2;
  int max_steps = 600;  // largest number of block steps
};

template <class Scalar>
struct EigenPairs {
  Eigen::VectorXd values;                                         // ascending lambda
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> vectors;  // columns, x' M x = 1
  bool converged = false;
  int solves = 0;  // number of right-hand sides solved
};

/// Finds the eigenvalues nearest above the shift. `start` holds approximate eigenvectors, for
/// example of a similar problem, the lowest first; it may have any number of columns, also none.
/// Good ones save most of the steps, bad ones are recognized and dropped. The result is
/// deterministic.
template <class Scalar>
EigenPairs<Scalar> lanczos(const EigenProblem<Scalar>& problem,
                           const LanczosSettings& settings,
                           const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>& start = {});

extern template EigenPairs<double> lanczos(const EigenProblem<double>&,
                                           const LanczosSettings&,
                                           const Eigen::MatrixXd&);
extern template EigenPairs<std::complex<double>> lanczos(const EigenProblem<std::complex<double>>&,
                                                         const LanczosSettings&,
                                                         const Eigen::MatrixXcd&);

}  // namespace latsch::numerics
