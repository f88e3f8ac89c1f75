// SPDX-License-Identifier: Apache-2.0
#include "optimization/sqp/l1_merit.h"

namespace latsch {
namespace {

constexpr double kAbove = 1.5;  // ratio of mu to its multiplier when mu is raised

void raise(Eigen::VectorXd& mu, const Eigen::VectorXd& multipliers) {
  const Eigen::VectorXd least = kAbove * multipliers.cwiseAbs();
  mu = mu.size() == 0 ? least : Eigen::VectorXd(least.cwiseMax(0.5 * (mu + least)));
}

}  // namespace

void L1Merit::raise_above(const SqpStep& step) {
  raise(mu_, step.mu);
  raise(lambda_, step.lambda);
}

double L1Merit::penalty(const Eigen::VectorXd& c, const Eigen::VectorXd& h) const {
  return mu_.dot(c.cwiseMax(0.0)) + lambda_.dot(h.cwiseAbs());
}

double L1Merit::operator()(const SmoothValues& values) const {
  return values.f + penalty(values.c, values.h);
}

double L1Merit::slope(const SmoothValues& values,
                      const SmoothSlopes& slopes,
                      const Eigen::VectorXd& d) const {
  return slopes.g.dot(d) + penalty(values.c + slopes.c * d, values.h + slopes.h * d) -
         penalty(values.c, values.h);
}

}  // namespace latsch
