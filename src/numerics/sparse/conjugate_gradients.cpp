// SPDX-License-Identifier: Apache-2.0
#include "numerics/sparse/conjugate_gradients.h"

#include <cmath>

namespace latsch::numerics {

ConjugateGradients::ConjugateGradients(int size) : r_(size), z_(size), p_(size), Ap_(size) {}

CgOutcome ConjugateGradients::solve(const Operator& A,
                                    const Preconditioner& C,
                                    const Eigen::VectorXd& b,
                                    double tolerance,
                                    int max_iterations,
                                    Eigen::VectorXd& x,
                                    bool foresees) {
  constexpr int kAFew = 5;
  // Share of max_iterations that the forecast number of iterations may reach.
  constexpr double kAsFast = 2.0 / 3.0;
  CgOutcome outcome;
  const double b_norm = b.norm();
  x.setZero(b.size());
  if (b_norm == 0.0) return outcome;
  r_ = b;
  z_ = r_;
  C(z_);
  p_ = z_;
  double rz = r_.dot(z_);
  outcome.residual = 1.0;
  for (;;) {
    if (outcome.iterations == max_iterations) {
      outcome.end = CgOutcome::End::iterations_spent;
      return outcome;
    }
    A(p_, Ap_);
    ++outcome.iterations;
    const double curvature = p_.dot(Ap_);
    if (!(curvature > 0.0) || !(rz > 0.0)) {
      if (outcome.iterations == 1) x = p_;
      outcome.end = CgOutcome::End::negative_curvature;
      return outcome;
    }
    const double alpha = rz / curvature;  // 5.39a
    x += alpha * p_;
    r_ -= alpha * Ap_;
    outcome.residual = r_.norm() / b_norm;
    if (outcome.residual <= tolerance) return outcome;
    if (foresees && outcome.iterations == kAFew &&
        kAFew * std::log(tolerance) < kAsFast * max_iterations * std::log(outcome.residual)) {
      outcome.end = CgOutcome::End::iterations_spent;
      return outcome;
    }
    z_ = r_;
    C(z_);
    const double rz_next = r_.dot(z_);
    p_ = z_ + (rz_next / rz) * p_;  // 5.39d, e
    rz = rz_next;
  }
}

}  // namespace latsch::numerics
