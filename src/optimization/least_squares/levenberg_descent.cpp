// SPDX-License-Identifier: Apache-2.0
#include "optimization/least_squares/levenberg_descent.h"

#include <algorithm>
#include <limits>

namespace latsch {
namespace {

constexpr int kMostIterations = 60;
// Share of the value: the descent ends if an iteration decreases the value by less.
constexpr double kLeastDecrease = 1e-9;
constexpr double kFirstDamping = 1e-6;  // first mu divided by the largest diagonal entry of J'J
constexpr double kLeastDamping = 1e-12;
constexpr double kMostDamping = 1e12;

}  // namespace

Eigen::VectorXd levenberg_descent(const ResidualKriging& model,
                                  Eigen::Index n,
                                  const DampedStep& step) {
  Eigen::VectorXd z = Eigen::VectorXd::Zero(n);
  double value = model.expected(z);
  double damping = kFirstDamping;
  for (int k = 0; k < kMostIterations && damping < kMostDamping;) {
    const Eigen::MatrixXd J = model.jacobian(z);
    const Eigen::VectorXd g = J.transpose() * model.residuals(z) + model.variance_gradient(z);
    const Eigen::MatrixXd H = J.transpose() * J + model.variance_hessian(z);
    const double scale = std::max(H.diagonal().maxCoeff(), std::numeric_limits<double>::min());
    for (bool descends = false; !descends && damping < kMostDamping; ++k) {
      Eigen::MatrixXd A = H;
      A.diagonal().array() += damping * scale;
      const Eigen::VectorXd next = step(z, A, g);
      const double value_next = model.expected(next);
      descends = value_next < value;
      damping = descends ? std::max(1e-2 * damping, kLeastDamping) : 10.0 * damping;
      if (!descends) continue;
      const bool is_end = value_next > (1.0 - kLeastDecrease) * value;
      z = next;
      value = value_next;
      if (is_end) return z;
    }
  }
  return z;
}

}  // namespace latsch
