// SPDX-License-Identifier: Apache-2.0
#include "optimization/identifiability/broyden_fit.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "numerics/dense/orthogonal_factors.h"
#include "optimization/least_squares/step_in_box.h"
#include "optimization/problem/quadratic_program.h"

namespace latsch {
namespace {

// Length of a difference, as a share of the range, if none is given.
constexpr double kDifference = 1e-3;
constexpr double kShortestStep = 1e-9;  // shortest step that is evaluated, as a share of the range
// Longest step of one variable, as a share of its range, because J is accurate only nearby.
constexpr double kLongestRefitStep = 0.25;
constexpr int kFailedSteps = 2;        // number of failed steps in a row before J is recomputed
constexpr double kFirstLambda = 1e-3;  // first lambda, relative to the largest entry of J'J
constexpr double kLambdaFactor = 10.0;
// Smallest curvature relative to the largest. A quadratic program needs positive curvature in all
// directions. Without this addition, a step in directions that the data do not determine would
// follow rounding errors over a long distance.
constexpr double kLeastCurvature = 1e-12;

/// Returns the step d in the variables `free` that minimizes |r + J d|^2 + lambda |d|^2, subject to
/// u + d in the unit cube and to the longest step of each variable.
Eigen::VectorXd bounded_step(const Linearization& at, const std::vector<int>& free, double lambda) {
  const auto step = [&](const Eigen::VectorXd& d, const std::vector<int>& columns) {
    const auto k = static_cast<Eigen::Index>(columns.size());
    const Eigen::Index m = at.r.size();
    Eigen::MatrixXd A(m + k, k);
    A.topRows(m) = at.J(Eigen::all, columns);
    const double scale = A.topRows(m).colwise().squaredNorm().maxCoeff();
    A.bottomRows(k) = std::sqrt(lambda + kLeastCurvature * scale) * Eigen::MatrixXd::Identity(k, k);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(m + k);
    b.head(m) = -(at.r + at.J * d);
    return numerics::shortest_solution(A, b);
  };
  return step_in_box((-at.u).cwiseMax(-kLongestRefitStep),
                     (1.0 - at.u.array()).min(kLongestRefitStep).matrix(),
                     free,
                     step);
}

/// Returns the step d in the variables `free` that minimizes |r + J d|^2 + lambda |d|^2, subject to
/// u + d in the region; nullopt if there is none.
std::optional<Eigen::VectorXd> constrained_step(const Eigen::MatrixXd& J,
                                                const Eigen::VectorXd& u,
                                                const Eigen::VectorXd& r,
                                                const std::vector<int>& free,
                                                double lambda,
                                                const FeasibleRegion& region) {
  const auto k = static_cast<Eigen::Index>(free.size());
  const Eigen::MatrixXd J_free = J(Eigen::all, free);
  Eigen::MatrixXd G = J_free.transpose() * J_free;
  const double scale = std::max(G.diagonal().maxCoeff(), std::numeric_limits<double>::min());
  G.diagonal().array() += lambda + kLeastCurvature * scale;
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(k, k);
  QuadraticProgram qp{G / scale, J_free.transpose() * r / scale, {}, {}, {}, {}};
  qp.E = region.E()(Eigen::all, free);
  qp.f = region.f() - region.E() * u;
  const Eigen::Index rows = region.A().rows();
  qp.A.resize(rows + 2 * k, k);
  qp.A << region.A()(Eigen::all, free), one, -one;
  qp.b.resize(rows + 2 * k);
  qp.b << region.b() - region.A() * u, Eigen::VectorXd::Constant(2 * k, kLongestRefitStep);
  const QuadraticSolution solution = solve(qp);
  if (!solution.is_feasible()) return std::nullopt;
  Eigen::VectorXd d = Eigen::VectorXd::Zero(u.size());
  for (Eigen::Index a = 0; a < k; ++a) d[free[a]] = solution.x[a];
  return d;
}

void broyden(Eigen::MatrixXd& J, const Eigen::VectorXd& d, const Eigen::VectorXd& change) {
  J += (change - J * d) * d.transpose() / d.squaredNorm();
}

}  // namespace

BroydenFit::BroydenFit(const Linearization& start,
                       std::vector<int> free,
                       const BroydenFitOptions& options)
    : best_(start), free_(std::move(free)), options_(options) {
  plan_step();
}

namespace {

/// Returns u with another value of variable i.
Eigen::VectorXd with_value(Eigen::VectorXd u, int i, double value) {
  u[i] = value;
  return u;
}

}  // namespace

BroydenFit::BroydenFit(const Linearization& start,
                       std::vector<int> free,
                       const BroydenFitOptions& options,
                       int i,
                       double value)
    : BroydenFit(start, std::move(free), options, with_value(start.u, i, value)) {}

BroydenFit::BroydenFit(const Linearization& start,
                       std::vector<int> free,
                       const BroydenFitOptions& options,
                       const Eigen::VectorXd& to)
    : best_(start), free_(std::move(free)), options_(options), moving_(true) {
  Eigen::VectorXd moved = to;
  moved(free_) = best_.u(free_);
  const Eigen::VectorXd shift = moved - best_.u;
  const auto d = step_from(moved, best_.r + best_.J * shift, 0.0);
  if (d) wanted_ = moved + *d;
}

std::optional<Eigen::VectorXd> BroydenFit::step_from(const Eigen::VectorXd& u,
                                                     const Eigen::VectorXd& r,
                                                     double lambda) const {
  if (free_.empty()) return Eigen::VectorXd::Zero(u.size());
  if (!is_constrained()) return bounded_step({u, r, best_.J}, free_, lambda);
  return constrained_step(best_.J, u, r, free_, lambda, *options_.region);
}

bool BroydenFit::promises(const Eigen::VectorXd& d) const {
  const double promised = best_.sum_of_squares() - (best_.r + best_.J * d).squaredNorm();
  return d.lpNorm<Eigen::Infinity>() >= kShortestStep && promised > options_.tolerance;
}

void BroydenFit::observe(const std::optional<Evaluated>& evaluated) {
  assert(wanted_);
  ++evaluations_;
  if (!columns_.empty()) {
    difference_observed(evaluated);
  } else {
    step_observed(evaluated);
  }
}

void BroydenFit::step_observed(const std::optional<Evaluated>& evaluated) {
  if (!evaluated && moving_) {
    wanted_.reset();
    return;
  }
  const Eigen::VectorXd d = *wanted_ - best_.u;
  const bool better = evaluated && (moving_ || evaluated->r.squaredNorm() < best_.r.squaredNorm());
  const bool has_slopes = better && evaluated->has_slopes();
  const bool corrects = evaluated && !has_slopes && (better || !best_.is_exact);
  if (corrects && d.squaredNorm() > 0.0) broyden(best_.J, d, evaluated->r - best_.r);
  moving_ = false;
  if (better) {
    best_.u = *wanted_;
    best_.r = evaluated->r;
    if (has_slopes) best_.J = evaluated->J;
    best_.is_exact = has_slopes;
    lambda_ = lambda_ > 0.0 ? lambda_ / kLambdaFactor : 0.0;
    failed_steps_ = 0;
  } else {
    const double least = kFirstLambda * best_.J.colwise().squaredNorm().maxCoeff();
    lambda_ = std::max(least, lambda_ * kLambdaFactor);
    if (++failed_steps_ == kFailedSteps && !best_.is_exact) {
      begin_differences(free_);
      return;
    }
  }
  plan_step();
}

void BroydenFit::difference_observed(const std::optional<Evaluated>& evaluated) {
  const int i = columns_[difference_];
  if (evaluated) best_.J.col(i) = (evaluated->r - best_.r) / ((*wanted_)[i] - best_.u[i]);
  ++difference_;
  plan_difference();
}

double BroydenFit::difference_of(int variable) const {
  return options_.differences.size() > 0 ? options_.differences[variable] : kDifference;
}

void BroydenFit::begin_differences(const std::vector<int>& columns) {
  columns_ = columns;
  difference_ = 0;
  plan_difference();
}

void BroydenFit::plan_difference() {
  for (; difference_ < static_cast<int>(columns_.size()); ++difference_) {
    const int i = columns_[difference_];
    for (const double side : {difference_of(i), -difference_of(i)}) {
      Eigen::VectorXd to = best_.u;
      to[i] += side;
      if (to[i] < 0.0 || to[i] > 1.0 || (is_constrained() && !options_.region->contains(to))) {
        continue;
      }
      wanted_ = to;
      return;
    }
  }
  columns_.clear();
  plan_step();
}

void BroydenFit::plan_step() {
  wanted_.reset();
  converged_ = free_.empty();
  if (converged_) return;
  // A large lambda shortens the step and hence its predicted gain, so convergence is judged by the
  // step with lambda = 0.
  const auto full = step_from(best_.u, best_.r, 0.0);
  if (!full) return;
  const bool has_enough = !promises(*full);
  if (has_enough && !options_.refresh.empty() && !verified_ && !best_.is_exact &&
      evaluations_ < options_.most_evaluations) {
    verified_ = true;
    begin_differences(options_.refresh);
    return;
  }
  converged_ = has_enough;
  if (converged_ || evaluations_ >= options_.most_evaluations) return;
  const auto d = lambda_ > 0.0 ? step_from(best_.u, best_.r, lambda_) : full;
  if (!d || !promises(*d)) return;
  wanted_ = (best_.u + *d).cwiseMax(0.0).cwiseMin(1.0);
}

}  // namespace latsch
