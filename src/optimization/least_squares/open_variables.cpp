// SPDX-License-Identifier: Apache-2.0
#include "optimization/least_squares/open_variables.h"

#include <cmath>

#include "numerics/dense/self_adjoint_eigen.h"

namespace latsch {
namespace {

// Largest relative error of a value that counts as determined.
constexpr double kDetermined = 0.05;
// Eigenvalue of M, scaled to columns of length 1, below which it counts as zero. Rounding makes
// eigenvalues of about 1e-16 of vanishing ones.
constexpr double kVanishing = 1e-14;

/// Returns for every variable how far it may be off, as a share of its range. Along a direction
/// without effect that is as far as the range of one variable allows.
Eigen::VectorXd possible_errors(const Eigen::MatrixXd& J,
                                const Eigen::MatrixXd& covariance,
                                double r) {
  const Eigen::MatrixXd squares = J.transpose() * J;
  const Eigen::VectorXd felt = (squares.diagonal() + covariance.diagonal()).cwiseSqrt();
  const Eigen::VectorXd scale = (felt.array() > 0.0).select(felt.cwiseInverse(), 1.0);
  const Eigen::MatrixXd M = scale.asDiagonal() * (squares - covariance) * scale.asDiagonal();
  const auto [values, V] = numerics::self_adjoint_eigen(M);
  Eigen::VectorXd square = Eigen::VectorXd::Zero(felt.size());
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    const Eigen::VectorXd move = scale.cwiseProduct(V.col(k));
    const double length =
        values[k] > kVanishing ? r / std::sqrt(values[k]) : 1.0 / move.lpNorm<Eigen::Infinity>();
    square += (length * move).cwiseAbs2();
  }
  return square.cwiseSqrt();
}

/// Returns the relative change of the variable's value over a small move du.
double relative_change(const DesignVariable& variable, double u, double du) {
  const double range = variable.upper - variable.lower;
  if (variable.scale == Scale::logarithmic) return du * std::log(variable.upper / variable.lower);
  const double value = std::abs(variable.lower + u * range);
  return value > 0.0 ? du * range / value : du;
}

}  // namespace

std::vector<std::string> open_variables(const DesignSpace& space,
                                        const Eigen::VectorXd& u,
                                        const PointSlopes& slopes,
                                        double r) {
  const Eigen::MatrixXd J = slopes.J.array().isFinite().select(slopes.J, 0.0);
  const Eigen::MatrixXd& C = slopes.covariance;
  const Eigen::VectorXd off = possible_errors(J, C.array().isFinite().select(C, 0.0), r);
  std::vector<std::string> names;
  for (int i = 0; i < space.size(); ++i)
    if (relative_change(space[i], u[i], off[i]) > kDetermined) names.push_back(space[i].name);
  return names;
}

}  // namespace latsch
