// SPDX-License-Identifier: Apache-2.0
#include "optimization/trust_region/open_variables.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/dense/singular_values.h"

namespace latsch {
namespace {

// Largest relative error of a value that counts as determined.
constexpr double kDetermined = 0.05;
// Share of the largest singular value below which a singular value counts as zero.
constexpr double kVanishing = 1e-13;

/// Returns for each column the root of the diagonal of (J'J)^-1.
Eigen::VectorXd spreads(const Eigen::MatrixXd& J) {
  const auto [values, V] = numerics::singular_values(J);
  Eigen::VectorXd all = Eigen::VectorXd::Zero(J.cols());
  all.head(values.size()) = values;
  const double least = std::max(kVanishing * all.maxCoeff(), std::numeric_limits<double>::min());
  return (V * all.cwiseMax(least).cwiseInverse().asDiagonal()).rowwise().norm();
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
                                        const Eigen::MatrixXd& J,
                                        double r) {
  const Eigen::MatrixXd slopes = J.array().isFinite().select(J, 0.0);
  const Eigen::VectorXd off = r * spreads(slopes);
  std::vector<std::string> names;
  for (int i = 0; i < space.size(); ++i)
    if (relative_change(space[i], u[i], off[i]) > kDetermined) names.push_back(space[i].name);
  return names;
}

}  // namespace latsch
