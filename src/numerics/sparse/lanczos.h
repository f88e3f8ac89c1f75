// SPDX-License-Identifier: Apache-2.0
// Lowest eigenvalues of K x = lambda M x by shift-invert Lanczos with full reorthogonalization in
// the M-inner product and thick restart.
//
// Law: the operator (K - sigma M)^-1 M is self-adjoint in the M-inner product; its largest
// eigenvalues theta give lambda = sigma + 1 / theta. A block of start vectors finds multiplicities
// up to the block size; further copies come by rounding alone, so choose the block no smaller.
// [Wu & Simon, Thick-restart Lanczos method for large symmetric eigenvalue problems,
//  SIAM J. Matrix Anal. Appl. 22 (2000)]
// [Grimes, Lewis & Simon, A shifted block Lanczos algorithm for solving sparse symmetric
//  generalized eigenproblems, SIAM J. Matrix Anal. Appl. 15 (1994)]
#pragma once

#include <Eigen/Core>
#include <complex>
#include <functional>

namespace latsch::numerics {

/// Scalar: double, or std::complex<double> for Hermitian K and M.
template <class Scalar>
struct EigenProblem {
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  int size = 0;
  double shift = 0.0;                               // sigma, below the wanted eigenvalues
  std::function<void(Eigen::Ref<Matrix> X)> solve;  // X <- (K - sigma M)^-1 X
  std::function<void(const Eigen::Ref<const Matrix>& X, Eigen::Ref<Matrix> Y)> mass;  // Y = M X
};

struct LanczosSettings {
  int count = 20;  // eigenpairs wanted
  /// Residual of the inverted problem relative to theta; theta errs by its square over the relative
  /// gap to the next one.
  double tolerance = 1e-8;
  int spare = 0;  // of the wanted ones the last, which may err by more
  double spare_tolerance = 0.0;
  /// Vectors a step: 1 for simple spectra, 2 finds both members of a pair; with a sparse factor 3
  /// to 5 are fastest, because right-hand sides are cheaper together.
  int block = 2;
  int max_steps = 600;  // block steps in all
};

template <class Scalar>
struct EigenPairs {
  Eigen::VectorXd values;                                         // ascending lambda
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> vectors;  // columns, x' M x = 1
  bool converged = false;
  int solves = 0;  // right-hand sides solved
};

/// The eigenvalues nearest above the shift. start: approximate eigenvectors from a neighboring
/// problem (any number of columns, the lowest first, also none): good ones save most of the steps,
/// bad ones are recognized and left. Deterministic.
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
