// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/analysis/equilibrium.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace latsch::fe_tire {
namespace {

using Tangent = RingBalance::Tangent;
using IfIndefinite = ReusedFactor::IfIndefinite;
using IfSlow = ReusedFactor::IfSlow;

constexpr const char* kNoTangent = "its tangent does not exist";

/// Stops the search for an equilibrium if indefinite tangents were shifted too often before the
/// residual has halved.
class ShiftLimit {
 public:
  ShiftLimit(double norm, int shifts, int most) : norm_(norm), most_(most), last_(shifts + most) {}

  /// Returns true if there were too many shifts before the residual fell to `norm`.
  bool is_exceeded(double norm, int shifts) {
    if (shifts > last_) return true;
    if (norm <= 0.5 * norm_) {
      norm_ = norm;
      last_ = shifts + most_;
    }
    return false;
  }

 private:
  double norm_;  // residual relative to which the next halving is judged, N
  int most_;     // largest number of shifts until the residual halves
  int last_;     // total number of shifts at which the search stops
};

}  // namespace

EquilibriumSolver::EquilibriumSolver(const RingUnknowns& unknowns,
                                     const TreadSurface& tread,
                                     const SolverSettings& settings,
                                     SolverCounts& counts,
                                     const EquilibriumOptions& options)
    : settings_(settings),
      options_(options),
      counts_(counts),
      balance_(unknowns, tread, counts),
      elimination_(std::make_shared<const numerics::Elimination>(
          numerics::eliminate(*assembly().pattern()))),
      factor_(*assembly().pattern(), *elimination_, tread, options.factor, counts),
      d_(unknowns.size()) {}

Status EquilibriumSolver::solve(const RingElements& elements,
                                AssembledState& state,
                                double pressure,
                                const TreadContact* contact,
                                const std::string& step) {
  factor_.begin(contact);
  AssembledState now = state;
  if (!balance_.begin(now, {&elements, pressure, contact}, !factor_.exists()))
    return failure(step, "the start is inverted");
  double previous = options_.norm_before * balance_.residual().norm();
  ShiftLimit limit(balance_.residual().norm(), counts_.shifts, settings_.max_shifts);
  for (int iteration = 0; iteration < settings_.max_iterations; ++iteration) {
    const double norm = balance_.residual().norm(), ratio = norm / previous;
    if (norm <= accepted()) {
      if (iteration > 0) polish(now);
      state = std::move(now);
      return {};
    }
    const bool keeps_tangent = ends_with_last_tangent(norm, ratio);
    if (iteration > 0 && !keeps_tangent && !balance_.ensure_tangent(now))
      return failure(step, kNoTangent);
    if (limit.is_exceeded(norm, counts_.shifts))
      return failure(step, "its tangents stay indefinite");
    const bool is_after_first_step = iteration == 1;
    const auto if_indefinite = is_after_first_step ? IfIndefinite::give_up : IfIndefinite::shift;
    if (!find_direction(now, linear_tolerance(ratio), if_indefinite)) {
      if (!is_after_first_step || !restart_between(state, now)) return failure(step, kNoTangent);
      previous = options_.norm_before * balance_.residual().norm();
      continue;
    }
    // Newton's method converges quadratically. If the next residual is expected to be small enough,
    // no new tangent is computed. The reduction in the first step does not predict the next one,
    // because it also contains the motion of the ground.
    const double expected = (is_after_first_step ? 1.0 : ratio * ratio) * norm;
    previous = norm;
    if (!line_search(now, !keeps_tangent && !(expected <= close())))
      return failure(step, "no step along Newton's direction reduces it");
  }
  return failure(step, fmt::format("not converged in {} iterations", settings_.max_iterations));
}

/// Returns the residual, N, below which the iteration ends with the last tangent.
double EquilibriumSolver::close() const {
  return (is_exact() ? 1.0 : options_.close) * settings_.tolerance * reference_;
}

/// Returns true if the iteration may end with the present tangent, because the residual is small
/// enough and falls fast.
bool EquilibriumSolver::ends_with_last_tangent(double norm, double ratio) const {
  return balance_.tangent() != Tangent::none && ratio < options_.closing_ratio && norm <= close() &&
         !is_exact();
}

/// Returns the relative tolerance of the linear solves. For small tolerances of the equilibrium the
/// linear equations are solved as accurately as the convergence of Newton's method justifies
/// (Eisenstat and Walker 1996, choice 2).
double EquilibriumSolver::linear_tolerance(double ratio) const {
  if (!is_exact()) return options_.linear_tolerance;
  return std::clamp(0.5 * ratio * ratio, options_.finest_linear, options_.coarsest_linear);
}

LinearizedRing EquilibriumSolver::linearized(const AssembledState& state) {
  return {balance_.K(), balance_.load().contact, state.x, balance_.residual()};
}

/// Computes Newton's direction, with the old factorization if it is still useful, otherwise with a
/// new one. Returns false if the tangent does not exist or cannot be factorized.
bool EquilibriumSolver::find_direction(AssembledState& state,
                                       double tolerance,
                                       IfIndefinite if_indefinite) {
  const bool is_tangent_new = balance_.tangent() == Tangent::current;
  const bool is_of_use = factor_.exists() && !(is_tangent_new && factor_.is_stale());
  if (is_of_use && factor_.find_first(linearized(state), d_) &&
      (balance_.tangent() == Tangent::none ||
       factor_.correct(linearized(state), tolerance, IfSlow::give_up, d_)))
    return true;
  return balance_.ensure_tangent(state) &&
         factor_.renew(linearized(state), tolerance, if_indefinite, d_);
}

/// Returns to a point between the start and the end of the first step. Returns false if the tangent
/// does not exist there.
bool EquilibriumSolver::restart_between(const AssembledState& start, AssembledState& now) {
  now.x = start.x + options_.taken_back * (now.x - start.x);
  now.alpha = start.alpha;
  factor_.forget();
  return balance_.evaluate(now, true);
}

bool EquilibriumSolver::line_search(AssembledState& state, bool wants_tangent) {
  const double norm = balance_.residual().norm(), slope = std::abs(d_.dot(balance_.residual()));
  double s = 1.0;
  for (int back = 0; back <= options_.max_backtracks; ++back, s *= 0.5) {
    trial_.x = state.x - s * d_;
    trial_.alpha = state.alpha;
    // The full step is nearly always accepted, so the tangent at its end is computed together with
    // the forces.
    const bool valid = balance_.evaluate(trial_, wants_tangent && back == 0);
    const Eigen::VectorXd& f = balance_.residual();
    if (valid && (f.norm() < norm || std::abs(d_.dot(f)) <= options_.slope_decrease * slope)) {
      std::swap(state, trial_);
      return true;
    }
  }
  return false;
}

/// Adds steps with the last tangent as long as they reduce the residual enough. Each costs one
/// evaluation of the forces. After this the displayed digits agree even on processors that add in
/// another order.
void EquilibriumSolver::polish(AssembledState& state) {
  if (!factor_.exists()) return;
  double enough = options_.polished;
  for (int pass = 0; pass < options_.max_polishing; ++pass, enough = options_.polished_again) {
    const double norm = balance_.residual().norm();
    if (norm <= enough * settings_.tolerance * reference_) return;
    if (!factor_.find_first(linearized(state), d_)) return;
    // The correction may be inexact, because it is accepted only if it reduces the residual of the
    // forces.
    factor_.correct(linearized(state), options_.polishing_tolerance, IfSlow::take_it, d_);
    trial_.x = state.x - d_;
    trial_.alpha = state.alpha;
    if (!balance_.evaluate(trial_, false) || !(balance_.residual().norm() < norm)) return;
    std::swap(state, trial_);
  }
}

bool EquilibriumSolver::follow(const RingElements& elements,
                               const AssembledState& state,
                               double pressure,
                               TreadContact& contact,
                               const std::vector<GroundPose>& poses) {
  AssembledState now = state;
  if (!balance_.begin(now, {&elements, pressure, &contact}, true)) {
    factor_.forget();
    return false;
  }
  balance_.recall_at(state);
  return factor_.follow(balance_.K(), contact, now.x, balance_.forces_off_ground(), poses);
}

Failure EquilibriumSolver::failure(const std::string& step, const std::string& what) const {
  return Failure{fmt::format("{}: {}; residual {:.3g} N, accepted {:.3g} N, {}",
                             step,
                             what,
                             balance_.residual().norm(),
                             accepted(),
                             balance_.worst_in_words())};
}

}  // namespace latsch::fe_tire
