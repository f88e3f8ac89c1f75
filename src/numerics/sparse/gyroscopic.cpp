// SPDX-License-Identifier: Apache-2.0
#include "numerics/sparse/gyroscopic.h"

#include <algorithm>
#include <complex>

#include "numerics/sparse/lanczos.h"

namespace latsch::numerics {

GyroscopicModes gyroscopic_modes(const GyroscopicProblem& problem,
                                 const BorderedCholesky& K_factor,
                                 int sign,
                                 int count,
                                 double tolerance) {
  const int m = problem.K.size();
  EigenProblem<std::complex<double>> linear;
  linear.size = 2 * m;
  linear.mass = [&](const Eigen::Ref<const Eigen::MatrixXcd>& X, Eigen::Ref<Eigen::MatrixXcd> Y) {
    problem.K.multiply(X.topRows(m), Y.topRows(m));
    problem.M.multiply(X.bottomRows(m), Y.bottomRows(m));
  };
  // The matrix X holds A z on entry. A^-1 B A^-1 (A z) = (K^-1 (M z_2 - G z_1), z_1), and X
  // contains M z_2.
  Eigen::MatrixXcd upper, product;
  linear.solve = [&](Eigen::Ref<Eigen::MatrixXcd> X) {
    upper = X.topRows(m);
    K_factor.solve(upper);
    product.resize(m, X.cols());
    problem.G.multiply(upper, product);
    product = X.bottomRows(m) - product;
    K_factor.solve(product);
    X.topRows(m) = static_cast<double>(sign) * product;
    X.bottomRows(m) = static_cast<double>(sign) * upper;
  };
  LanczosSettings settings;
  settings.count = std::min(count, m);
  settings.tolerance = tolerance;
  settings.block = 1;
  const auto pairs = lanczos(linear, settings);
  GyroscopicModes modes;
  modes.omega = static_cast<double>(sign) * pairs.values;
  modes.phi = pairs.vectors.topRows(m);
  modes.converged = pairs.converged;
  modes.solves = pairs.solves;
  return modes;
}

bool no_mode_below(const GyroscopicProblem& problem, double omega) {
  BorderedHermitian P = problem.K;
  P.add(omega, problem.G);
  P.add(-omega * omega, problem.M);
  return BorderedCholesky().factorize(P);
}

}  // namespace latsch::numerics
