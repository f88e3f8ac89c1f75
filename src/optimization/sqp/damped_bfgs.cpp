// SPDX-License-Identifier: Apache-2.0
#include "optimization/sqp/damped_bfgs.h"

namespace latsch {
namespace {

constexpr double kDamped = 0.2;     // smallest share of the curvature along s that B keeps
constexpr double kNothing = 1e-14;  // length below which a step carries no information

}  // namespace

Eigen::MatrixXd damped_bfgs(Eigen::MatrixXd B,
                            const Eigen::VectorXd& s,
                            const Eigen::VectorXd& y,
                            bool is_first) {
  if (s.norm() < kNothing) return B;
  const double sy = s.dot(y);
  if (is_first && sy > 0.0)
    B = sy / s.squaredNorm() * Eigen::MatrixXd::Identity(s.size(), s.size());
  const Eigen::VectorXd Bs = B * s;
  const double sBs = s.dot(Bs);
  const double theta = sy >= kDamped * sBs ? 1.0 : (1.0 - kDamped) * sBs / (sBs - sy);  // (18.15)
  const Eigen::VectorXd r = theta * y + (1.0 - theta) * Bs;                             // (18.14)
  B += r * r.transpose() / s.dot(r) - Bs * Bs.transpose() / sBs;                        // (18.16)
  return 0.5 * (B + B.transpose());
}

}  // namespace latsch
