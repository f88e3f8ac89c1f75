// SPDX-License-Identifier: Apache-2.0
// Newton's method on the ring with a factorization that is reused although it is of an earlier
// state.
//
// The residual f and its tangent K are those of ring_balance.h. One factorization of a tangent
// serves several Newton iterations and load steps (reused_factor.h):
//
//   while |f(x)| > tolerance:
//     d   <- K(x)^-1 f(x), or the solution of (L.1), with a factor of K at an earlier state
//     x   <- x - s d       with s from a line search on d . f
//
// A tangent that is not positive definite (long steps cause this) is shifted along its diagonal
// until it is.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "models/fe_tire/analysis/equilibrium_options.h"
#include "models/fe_tire/analysis/reused_factor.h"
#include "models/fe_tire/analysis/ring_balance.h"
#include "models/fe_tire/analysis/solver_settings.h"
#include "numerics/sparse/elimination.h"

namespace latsch::fe_tire {

class EquilibriumSolver {
 public:
  /// `tread` and `counts`, to which the work is added, must outlive the solver.
  EquilibriumSolver(const RingUnknowns& unknowns,
                    const TreadSurface& tread,
                    const SolverSettings& settings,
                    SolverCounts& counts,
                    const EquilibriumOptions& options = {});

  /// Brings `state` into equilibrium under pressure and contact (may be null). A Failure names
  /// `step`, the residual and the worst element; `state` then is unchanged.
  Status solve(const RingElements& elements,
               AssembledState& state,
               double pressure,
               const TreadContact* contact,
               const std::string& step);

  /// Follows the ground from the equilibrium `state` on the linear tire, pose by pose. `contact`
  /// then starts from the last pose. Returns false if the linear tire is not positive definite on
  /// that ground.
  bool follow(const RingElements& elements,
              const AssembledState& state,
              double pressure,
              TreadContact& contact,
              const std::vector<GroundPose>& poses);

  /// Sets the force norm that `tolerance` is relative to: that of the pressure on the undeformed
  /// tire, N.
  void set_reference(double force) { reference_ = force; }
  /// Called if the tire's values changed: the factor then belongs to another matrix (still a
  /// preconditioner, but a poor one).
  void forget_factor() { factor_.forget(); }
  /// Frees the factor's memory.
  void release() { factor_.release(); }
  /// Called if the elements changed: the forces stored for the last state are then invalid.
  void forget_forces() { balance_.forget(); }

  /// Solves x <- K^-1 x by the factor at hand, until the residual is `enough` of x. K is the
  /// tangent, ground included, about the equilibrium with which solve() ended. Returns false, with
  /// x unchanged, if the factor is too far off for that.
  bool solve_nearby(const numerics::SymmetricMatrix& K, double enough, Eigen::VectorXd& x) {
    return factor_.solve_nearby(K, enough, x);
  }

  const RingAssembly& assembly() const { return balance_.assembly(); }
  /// Elimination order of the pattern, the ground's part included, for callers that factorize such
  /// tangents.
  const std::shared_ptr<const numerics::Elimination>& elimination() const { return elimination_; }

 private:
  /// Residual with which a state is an equilibrium, N.
  double accepted() const { return settings_.tolerance * reference_; }
  bool is_exact() const { return settings_.tolerance < options_.exact; }
  double close() const;
  bool ends_with_last_tangent(double norm, double ratio) const;
  double linear_tolerance(double ratio) const;
  LinearizedRing linearized(const AssembledState& state);
  bool find_direction(AssembledState& state,
                      double tolerance,
                      ReusedFactor::IfIndefinite if_indefinite);
  bool restart_between(const AssembledState& start, AssembledState& now);
  bool line_search(AssembledState& state, bool wants_tangent);
  void polish(AssembledState& state);
  Failure failure(const std::string& step, const std::string& what) const;

  SolverSettings settings_;
  EquilibriumOptions options_;
  SolverCounts& counts_;
  RingBalance balance_;
  std::shared_ptr<const numerics::Elimination> elimination_;
  ReusedFactor factor_;
  double reference_ = 0.0;
  Eigen::VectorXd d_;     // Newton's direction
  AssembledState trial_;  // state at the end of a step that is not yet accepted
};

}  // namespace latsch::fe_tire
