// SPDX-License-Identifier: Apache-2.0
#include "optimization/least_squares/levenberg_marquardt_step.h"

#include <algorithm>
#include <cmath>

#include "numerics/dense/orthogonal_factors.h"
#include "optimization/least_squares/step_in_box.h"
#include "optimization/problem/quadratic_program.h"

namespace latsch {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Accuracy to which the step is made as long as the radius, as a share of the radius.
constexpr double kRadiusSlack = 0.1;
// Distance from the ends of a bracket, as a share of its width, within which the result of a secant
// step is not trusted.
constexpr double kMargin = 1e-3;
// Largest damping mu that is tried if a step gains nothing, as a multiple of the mu for the radius.
constexpr double kMostDampingOfStep = 1e12;
// Largest number of values of mu that are tried; each at least halves the bracket.
constexpr int kMostDampings = 30;
// Smallest curvature in a quadratic program relative to the largest one.
constexpr double kLeastConvexity = 1e-12;

/// Returns the first rows of Q'A, as many as the matrix has columns, with Q from its factors.
MatrixXd rotated(const numerics::HouseholderQr& factors, const MatrixXd& A, Eigen::Index rows) {
  MatrixXd R(rows, A.cols());
  for (Eigen::Index j = 0; j < A.cols(); ++j) {
    R.col(j) = factors.times_Q_transposed(A.col(j)).head(rows);
  }
  return R;
}

/// Scales the constraints as rows of length 1 in the scaled variables D p.
void scale(MatrixXd& A, VectorXd& b, const VectorXd& D) {
  A = A * D.cwiseInverse().asDiagonal();
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    const double length = A.row(i).norm();
    A.row(i) /= length;
    b[i] /= length;
  }
}

}  // namespace

LevenbergMarquardtSteps::LevenbergMarquardtSteps(const VectorXd& r,
                                                 const MatrixXd& J,
                                                 const VectorXd& D,
                                                 const VectorXd& u,
                                                 const FeasibleRegion& region)
    : is_cube_(region.is_cube()), D_(D), R_(J * D.cwiseInverse().asDiagonal()), c_(r) {
  const Eigen::Index n = D.size();
  g_ = R_.transpose() * c_;
  if (R_.rows() > n) {
    const numerics::HouseholderQr factors(R_);
    c_ = factors.times_Q_transposed(r).head(n);
    R_ = rotated(factors, R_, n);
  }
  if (is_cube_) {
    lower_ = -D.cwiseProduct(u);
    upper_ = D.cwiseProduct(VectorXd::Ones(n) - u);
    free_ = free_in_box(VectorXd::Zero(n), g_, lower_, upper_);
  } else {
    E_ = region.E(), f_ = region.f() - E_ * u;
    A_ = region.A(), b_ = (region.b() - A_ * u).cwiseMax(0.0);
    scale(E_, f_, D);
    scale(A_, b_, D);
  }
  full_ = damped(0.0);
  if (is_cube_) {
    VectorXd y = VectorXd::Zero(n);
    y(free_) = solve_free(y, free_, 0.0);
    most_promised_ = promised(y);
    for (const int i : free_) promised_by_one_ = std::max(promised_by_one_, g_[i] * g_[i]);
  } else {
    most_promised_ = promised_by_one_ = full_.promised;
  }
}

double LevenbergMarquardtSteps::promised(const VectorXd& y) const {
  return -2.0 * g_.dot(y) - (R_ * y).squaredNorm();
}

LevenbergMarquardtStep LevenbergMarquardtSteps::damped(double mu) const {
  const VectorXd y = is_cube_ ? damped_in_box(mu) : damped_in_polytope(mu);
  return {y.cwiseQuotient(D_), y.norm(), mu, promised(y), g_.dot(y)};
}

VectorXd LevenbergMarquardtSteps::solve_free(const VectorXd& y,
                                             const std::vector<int>& free,
                                             double mu) const {
  const Eigen::Index k = std::ssize(free), m = mu > 0.0 ? k : 0;
  if (k == 0) return {};
  MatrixXd A = MatrixXd::Zero(R_.rows() + m, k);
  A.topRows(R_.rows()) = R_(Eigen::all, free);
  A.bottomRows(m).diagonal().setConstant(std::sqrt(mu));
  VectorXd b = VectorXd::Zero(R_.rows() + m);
  b.head(R_.rows()) = -(c_ + R_ * y);
  return numerics::shortest_solution(A, b);
}

VectorXd LevenbergMarquardtSteps::damped_in_box(double mu) const {
  const auto step = [&](const VectorXd& y, const std::vector<int>& free) {
    return solve_free(y, free, mu);
  };
  return step_in_box(lower_, upper_, free_, step);
}

VectorXd LevenbergMarquardtSteps::damped_in_polytope(double mu) const {
  MatrixXd G = R_.transpose() * R_;
  const double size = std::max(G.diagonal().maxCoeff(), mu);
  if (!(size > 0.0)) return VectorXd::Zero(D_.size());
  G.diagonal().array() += mu + kLeastConvexity * size;
  const QuadraticSolution found = solve({G / size, g_ / size, E_, f_, A_, b_});
  return found.is_feasible() ? found.x : VectorXd::Zero(D_.size());
}

LevenbergMarquardtStep LevenbergMarquardtSteps::within(double radius) const {
  const double longest = (1.0 + kRadiusSlack) * radius, shortest = (1.0 - kRadiusSlack) * radius;
  if (full_.length <= longest && full_.promised > 0.0) return full_;
  // The function excess(mu) = 1 / |D p| - 1 / Delta increases from a negative to a positive value.
  const auto excess = [&](const LevenbergMarquardtStep& s) {
    return 1.0 / s.length - 1.0 / radius;
  };
  const double of_radius = g_.norm() / radius;
  double low = 0.0, high = of_radius;
  double at_low = excess(full_);
  LevenbergMarquardtStep step = damped(high);
  double at_high = excess(step);
  // The full step is short enough but was rejected because it predicts no decrease.
  const bool is_cut = full_.length <= longest;
  for (int k = 0; k < kMostDampings && !is_cut; ++k) {
    if (step.length >= shortest && step.length <= longest) break;
    double mu = low - at_low * (high - low) / (at_high - at_low);
    const double margin = kMargin * (high - low);
    const bool is_between = mu > low + margin && mu < high - margin;
    if (!is_between) mu = low > 0.0 ? std::sqrt(low * high) : kMargin * high;
    step = damped(mu);
    (step.length > radius ? low : high) = mu;
    (step.length > radius ? at_low : at_high) = excess(step);
  }
  // If variables are held at faces of the cube, a step may predict no decrease. Shorter and shorter
  // steps approach the direction of steepest descent, which does.
  const double most = kMostDampingOfStep * of_radius;
  for (double mu = step.mu; !(step.promised > 0.0) && mu < most; mu *= 10.0) {
    step = damped(10.0 * mu);
  }
  return step;
}

}  // namespace latsch
