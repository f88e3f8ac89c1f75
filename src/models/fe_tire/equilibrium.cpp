// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/equilibrium.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace latsch::fe_tire {
namespace {

// A factorization costs as much as about 13 conjugate-gradient iterations (measured on tires A and
// B); to give up as early as that gained nothing over thirteen tires.
constexpr int kIterationsWorthAFactor = 20;
// A solve that needed this many is a sign that the next one will be too slow.
constexpr int kIterationsOfAStaleFactor = 9;
constexpr int kMaxBacktracks = 10;
constexpr double kSlopeDecrease = 0.8;  // accepted |d . f(x - s d)| relative to |d . f(x)|

}  // namespace

EquilibriumSolver::EquilibriumSolver(const RingUnknowns& unknowns, const SolverSettings& settings)
    : settings_(settings),
      assembly_(unknowns),
      K_(*assembly_.pattern()),
      factor_(*assembly_.pattern(), numerics::Precision::single),
      cg_(unknowns.size()),
      f_(unknowns.size()),
      d_(unknowns.size()) {}

std::optional<Failure> EquilibriumSolver::solve(const RingElements& elements,
                                                RingState& state,
                                                double pressure,
                                                const GroundContact* contact,
                                                const std::string& step) {
  elements_ = &elements;
  contact_ = contact;
  pressure_ = pressure;
  shift_ = 0.0;
  RingState now = state;
  if (!assemble(now, true)) return failure(step, "the start is inverted");
  double previous = f_.norm();
  for (int iteration = 0; iteration < settings_.max_iterations; ++iteration) {
    const double norm = f_.norm();
    if (norm <= settings_.tolerance * reference_) {
      state = std::move(now);
      return std::nullopt;
    }
    if (!has_tangent_ && !assemble(now, true)) {
      return failure(step, "its tangent does not exist");
    }
    const double ratio = iteration == 0 ? 0.1 : norm / previous;
    // Solve only as exactly as Newton's own convergence deserves (Eisenstat and Walker 1996, choice
    // 2).
    find_direction(std::clamp(0.5 * ratio * ratio, 1e-4, 1e-2));
    previous = norm;
    if (!line_search(now)) return failure(step, "no step along Newton's direction reduces it");
  }
  return failure(step, fmt::format("not converged in {} iterations", settings_.max_iterations));
}

bool EquilibriumSolver::assemble(RingState& state, bool with_tangent) {
  failed_element_ = -1;
  has_tangent_ = with_tangent;
  if (with_tangent) ++counts_.assemblies;
  return assembly_.assemble(
      *elements_, state, pressure_, contact_, f_, with_tangent ? &K_ : nullptr, &failed_element_);
}

bool EquilibriumSolver::factorize() {
  ++counts_.factorizations;
  has_factor_ = false;
  return factor_.factorize(K_).definite();
}

void EquilibriumSolver::renew_factor() {
  const double largest = K_.diagonal().maxCoeff();
  // What the last indefinite tangent of this equilibrium needed is where to begin with the next.
  double shift = std::max(1e-5 * largest, 0.25 * shift_);
  for (; !factorize(); shift *= 4.0) {
    K_.add_to_diagonal(shift);
    shift_ = shift;
    ++counts_.shifts;
  }
  has_factor_ = true;
  last_cg_iterations_ = 0;
}

void EquilibriumSolver::find_direction(double tolerance) {
  if (has_factor_ && last_cg_iterations_ <= kIterationsOfAStaleFactor && solve_tangent(tolerance)) {
    return;
  }
  renew_factor();
  solve_tangent(tolerance);  // even where it stops early, what it has is a direction of descent
}

bool EquilibriumSolver::solve_tangent(double tolerance) {
  const auto multiply = [this](const Eigen::VectorXd& v, Eigen::VectorXd& Kv) {
    K_.multiply(v.data(), Kv.data());
  };
  const auto precondition = [this](Eigen::VectorXd& v) {
    ++counts_.solves;
    factor_.solve(v);
  };
  const numerics::CgOutcome cg =
      cg_.solve(multiply, precondition, f_, tolerance, kIterationsWorthAFactor, d_);
  counts_.cg_iterations += cg.iterations;
  last_cg_iterations_ = cg.iterations;
  return cg.end == numerics::CgOutcome::End::converged;
}

bool EquilibriumSolver::line_search(RingState& state) {
  const double norm = f_.norm(), slope = std::abs(d_.dot(f_));
  double s = 1.0;
  for (int back = 0; back <= kMaxBacktracks; ++back, s *= 0.5) {
    trial_.x = state.x - s * d_;
    trial_.alpha = state.alpha;
    // The full step is taken nearly always: its tangent comes in the same pass.
    const bool valid = assemble(trial_, back == 0);
    if (valid && (f_.norm() < norm || std::abs(d_.dot(f_)) <= kSlopeDecrease * slope)) {
      std::swap(state, trial_);
      return true;
    }
  }
  return false;
}

std::string EquilibriumSolver::worst_place() const {
  const Ring& ring = assembly_.unknowns().ring();
  int element = failed_element_;
  if (element < 0) {
    double largest = -1.0;
    const std::vector<std::vector<int>> dofs = assembly_.unknowns().connectivity();
    for (int e = 0; e < static_cast<int>(dofs.size()); ++e) {
      double here = 0.0;
      for (int dof : dofs[e]) {
        if (dof >= 0) here = std::max(here, std::abs(f_[dof]));
      }
      if (here > largest) {
        largest = here;
        element = e;
      }
    }
  }
  return ring.place(element);
}

Failure EquilibriumSolver::failure(const std::string& step, const std::string& what) const {
  return Failure{fmt::format("{}: {}; residual {:.3g} N, accepted {:.3g} N, {} at {}",
                             step,
                             what,
                             f_.norm(),
                             settings_.tolerance * reference_,
                             failed_element_ >= 0 ? "inverted" : "largest",
                             worst_place())};
}

}  // namespace latsch::fe_tire
