// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/analysis/equilibrium.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "numerics/sparse/gmres.h"

namespace latsch::fe_tire {
namespace {

// Number of conjugate-gradient iterations that cost as much as a factorization (measured on tires A
// and B).
constexpr int kIterationsWorthAFactor = 20;
// Most iterations of a solution to the last digits. A factorization of its own and three solves
// cost as much as 12 to 17 iterations; a solution that has come this far converges sooner than
// that.
constexpr int kIterationsOfOwnFactor = 24;
// A solve that needs more iterations than this marks the factor as too old for the next one.
constexpr int kIterationsOfAStaleFactor = 9;
// Relative residual to which linear equations are solved. A smaller one gains nothing, because
// cords that go slack or taut leave about as much. If Newton's method continues below kExact, the
// tolerance lies between kFinest and kCoarsest.
constexpr double kLinear = 3e-2;
constexpr double kCoarsest = 1e-2, kFinest = 1e-4;
// Share of the first step that is kept if the step ended where the tangent is indefinite.
constexpr double kTakenBack = 0.5;
// Relative to the tolerance: residual below which the first polishing pass, and the following ones,
// are not worth their cost. Smaller values polish more.
constexpr double kPolished = 1e-3, kPolishedAgain = 1e-2;
constexpr int kMostPolishing = 3;
// Residual reduction that each polishing solve must reach. It is tight because the load acts
// through the soft motions of the tire, whose relative error is larger than the residual's.
constexpr double kOfPolishing = 1e-3;
constexpr double kLargestShift = 1e3;  // relative to the diagonal
// The iteration ends with the last tangent, without a new one, from kClose times the tolerance on,
// if the residual falls below kSlow of the previous one. Cords that go slack or taut slow it down
// before that.
constexpr double kClose = 100.0, kSlow = 0.1;
// Tolerances below this are met with a new tangent in every iteration: the residual is then far
// smaller.
constexpr double kExact = 1e-7;
constexpr int kMaxBacktracks = 10;
constexpr double kSlopeDecrease = 0.8;  // accepted |d . f(x - s d)| relative to |d . f(x)|

}  // namespace

EquilibriumSolver::EquilibriumSolver(const RingUnknowns& unknowns,
                                     const TreadSurface& tread,
                                     const SolverSettings& settings)
    : settings_(settings),
      assembly_(unknowns, &tread),
      tread_(tread),
      K_(*assembly_.pattern()),
      elimination_(
          std::make_shared<const numerics::Elimination>(numerics::eliminate(*assembly_.pattern()))),
      tire_(*assembly_.pattern(), *elimination_, tread),
      cg_(unknowns.size()),
      f_(unknowns.size()),
      d_(unknowns.size()) {}

Status EquilibriumSolver::solve(const RingElements& elements,
                                AssembledState& state,
                                double pressure,
                                const TreadContact* contact,
                                const std::string& step) {
  contact_ = contact;
  shift_ = 0.0;
  failed_element_ = -1;
  has_factor_ = has_factor_ && tire_.serves(contact);
  AssembledState now = state;
  knows_tangent_ = is_first_ = false;
  if (!begin(now, elements, pressure)) return failure(step, "the start is inverted");
  const double close =
      (settings_.tolerance < kExact ? 1.0 : kClose) * settings_.tolerance * reference_;
  previous_ = 10.0 * f_.norm();
  int most_shifts = counts_->shifts + settings_.max_shifts;
  double halved = f_.norm();
  for (int iteration = 0; iteration < settings_.max_iterations; ++iteration) {
    const double norm = f_.norm(), ratio = norm / previous_;
    if (norm <= settings_.tolerance * reference_) {
      if (iteration > 0) polish(now);
      state = std::move(now);
      return {};
    }
    const bool is_close =
        knows_tangent_ && ratio < kSlow && norm <= close && settings_.tolerance >= kExact;
    if (iteration > 0 && !has_tangent_ && !is_close && !assemble(now, true)) {
      return failure(step, "its tangent does not exist");
    }
    if (counts_->shifts > most_shifts) return failure(step, "its tangents stay indefinite");
    if (norm <= 0.5 * halved) {
      halved = norm;
      most_shifts = counts_->shifts + settings_.max_shifts;
    }
    is_first_ = iteration == 1;
    if (!find_direction(now, linear_tolerance(ratio))) {
      if (!is_first_) return failure(step, "its tangent does not exist");
      now.x = state.x + kTakenBack * (now.x - state.x);
      now.alpha = state.alpha;
      has_factor_ = false;
      if (!assemble(now, true)) return failure(step, "its tangent does not exist");
      previous_ = 10.0 * f_.norm();
      continue;
    }
    // Newton's method converges quadratically. If the next residual is expected to be close enough,
    // no further tangent is made. The ratio of the first step says nothing about this, because it
    // contains the ground's motion.
    const bool ends = is_close || (is_first_ ? 1.0 : ratio * ratio) * norm <= close;
    previous_ = norm;
    if (!line_search(now, !ends))
      return failure(step, "no step along Newton's direction reduces it");
  }
  return failure(step, fmt::format("not converged in {} iterations", settings_.max_iterations));
}

/// Returns the relative residual of the linear equations. For small tolerances they are solved as
/// accurately as Newton's own convergence justifies (Eisenstat and Walker 1996, choice 2).
double EquilibriumSolver::linear_tolerance(double ratio) const {
  if (settings_.tolerance >= kExact) return kLinear;
  return std::clamp(0.5 * ratio * ratio, kFinest, kCoarsest);
}

/// Adds steps with the last tangent as long as they help. Each costs one pass of forces only, and
/// results then agree in the displayed digits on processors whose sums differ.
void EquilibriumSolver::polish(AssembledState& state) {
  if (!has_factor_) return;
  double enough = kPolished;
  for (int pass = 0; pass < kMostPolishing; ++pass, enough = kPolishedAgain) {
    const double norm = f_.norm();
    if (norm <= enough * settings_.tolerance * reference_ || !start(state)) return;
    correct(kOfPolishing, false);  // The forces judge the correction.
    trial_.x = state.x - d_;
    trial_.alpha = state.alpha;
    if (!assemble(trial_, false) || !(f_.norm() < norm)) return;
    std::swap(state, trial_);
  }
}

bool EquilibriumSolver::follow(const RingElements& elements,
                               const AssembledState& state,
                               double pressure,
                               TreadContact& contact,
                               const std::vector<GroundPose>& poses) {
  contact_ = &contact;
  elements_ = &elements;
  pressure_ = pressure;
  AssembledState now = state;
  has_factor_ = assemble(now, true) && factorize() && tire_.follow(K_, contact, now.x, g_, poses);
  known_ = state;
  return has_factor_;
}

/// Starts the iteration. The factor of the last equilibrium serves the ground's motion as well as a
/// new one, and if the state is the one last seen, its elements' forces are known.
bool EquilibriumSolver::begin(AssembledState& state,
                              const RingElements& elements,
                              double pressure) {
  const bool is_known = has_factor_ && elements_ == &elements && pressure_ == pressure &&
                        known_.x == state.x && known_.alpha == state.alpha;
  elements_ = &elements;
  pressure_ = pressure;
  if (!is_known) return assemble(state, !has_factor_);
  has_tangent_ = false;
  f_ = g_;
  add_contact(state);
  return true;
}

bool EquilibriumSolver::assemble(AssembledState& state, bool with_tangent) {
  failed_element_ = -1;
  has_tangent_ = with_tangent;
  knows_tangent_ = knows_tangent_ || with_tangent;
  if (with_tangent) ++counts_->assemblies;
  const bool valid =
      with_tangent
          ? assembly_.assemble_roughly(*elements_, state, pressure_, f_, K_, &failed_element_)
          : assembly_.assemble(*elements_, state, pressure_, f_, nullptr, &failed_element_);
  if (!valid) return false;
  g_ = f_;
  known_ = state;
  add_contact(state);
  return true;
}

void EquilibriumSolver::add_contact(const AssembledState& state) {
  if (contact_) add_forces(tread_, contact_->touches(tread_.displacements(state.x)), f_);
}

bool EquilibriumSolver::factorize() {
  ++counts_->factorizations;
  has_factor_ = tire_.factorize(K_, contact_);
  last_cg_iterations_ = 0;
  return has_factor_;
}

/// Finds a direction by a new factor. Shifts the tangent along its diagonal until it is positive
/// definite. Returns false if no shift helps, as with values that are not numbers, or if the first
/// step led to an indefinite tangent: that step can be shortened.
bool EquilibriumSolver::renew_factor(const AssembledState& state, double tolerance) {
  const double largest = K_.diagonal().maxCoeff();
  // The shift starts from that of the last indefinite tangent of this equilibrium.
  double shift = std::max(1e-5 * largest, 0.25 * shift_);
  while (!factorize() || !start(state)) {
    if (is_first_ || !(shift < kLargestShift * largest)) return false;
    K_.add_to_diagonal(shift);
    shift_ = shift;
    ++counts_->shifts;
    shift *= 4.0;
  }
  correct(tolerance, false);  // Even if it stops early, the result is a direction of descent.
  return true;
}

/// Finds a first direction, with the present ground, by the factor's tangent.
bool EquilibriumSolver::start(const AssembledState& state) {
  ++counts_->solves;
  return tire_.step(contact_, state.x, f_, d_);
}

/// Finds a direction by the old factor if it is of use, or by a new one. Returns false if the
/// tangent does not exist or has no factor.
bool EquilibriumSolver::find_direction(AssembledState& state, double tolerance) {
  const bool is_factor_of_use =
      has_factor_ && (!has_tangent_ || last_cg_iterations_ <= kIterationsOfAStaleFactor);
  if (is_factor_of_use && start(state) && (!knows_tangent_ || correct(tolerance, true)))
    return true;
  if (!has_tangent_ && !assemble(state, true)) return false;
  return renew_factor(state, tolerance);
}

/// Improves the direction to the tolerance with the current tangent: by conjugate gradients on the
/// residual, or by minimal residuals if something slides, because that tangent is not symmetric.
bool EquilibriumSolver::correct(double tolerance, bool may_give_up) {
  r_ = tire_.residual(K_, d_);
  const double wanted = tolerance * f_.norm(), norm = r_.norm();
  last_cg_iterations_ = 0;
  if (norm <= wanted) return true;
  // A factor whose step increases the residual belongs to another structure.
  if (may_give_up && norm > f_.norm()) return false;
  const auto multiply = [this](const Eigen::VectorXd& v, Eigen::VectorXd& Kv) {
    tire_.multiply(K_, v, Kv);
  };
  const auto precondition = [this](Eigen::VectorXd& v) {
    ++counts_->solves;
    tire_.precondition(v);
  };
  const auto solve = [&](auto&& method) {
    return method(multiply, precondition, r_, wanted / norm, kIterationsWorthAFactor, e_);
  };
  const numerics::CgOutcome cg = tire_.is_symmetric()
                                     ? solve([this](auto&&... all) { return cg_.solve(all...); })
                                     : solve([](auto&&... all) { return numerics::gmres(all...); });
  counts_->cg_iterations += cg.iterations;
  last_cg_iterations_ = cg.iterations;
  const bool converged = cg.end == numerics::CgOutcome::End::converged;
  if (converged || !may_give_up) d_ += e_;
  return converged;
}

bool EquilibriumSolver::solve_nearby(const numerics::SymmetricMatrix& K,
                                     double enough,
                                     Eigen::VectorXd& x) {
  if (!has_factor_ || !tire_.is_symmetric()) return false;
  const auto multiply = [&K](const Eigen::VectorXd& v, Eigen::VectorXd& Kv) {
    Kv.resize(v.size());
    K.multiply(v.data(), Kv.data());
  };
  const auto precondition = [this](Eigen::VectorXd& v) { tire_.precondition(v); };
  const numerics::CgOutcome cg =
      cg_.solve(multiply, precondition, x, enough, kIterationsOfOwnFactor, e_, true);
  if (cg.end != numerics::CgOutcome::End::converged) return false;
  x = e_;
  return true;
}

bool EquilibriumSolver::line_search(AssembledState& state, bool wants_tangent) {
  const double norm = f_.norm(), slope = std::abs(d_.dot(f_));
  double s = 1.0;
  for (int back = 0; back <= kMaxBacktracks; ++back, s *= 0.5) {
    trial_.x = state.x - s * d_;
    trial_.alpha = state.alpha;
    // The full step is nearly always accepted, so its tangent is computed in the same pass.
    const bool valid = assemble(trial_, wants_tangent && back == 0);
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
