// SPDX-License-Identifier: Apache-2.0
// Newton's method for the equilibrium of the tire's ring of sectors, with a factorization that is
// reused for several states.
//
// The residual f and its tangent K are those of ring_balance.h. One factorization of a tangent
// serves several Newton iterations and load steps (reused_factor.h):
//
//   while |f(x)| > tolerance:
//     d   <- K(x)^-1 f(x), or the solution of (L.1), with a factorization of K at an earlier state
//     x   <- x - s d       with s from a line search on d . f
//
// A tangent that is not positive definite, as long steps may cause, is shifted along its diagonal
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
  /// The solver adds its work to `counts`. `tread` and `counts` must outlive the solver.
  EquilibriumSolver(const RingUnknowns& unknowns,
                    const TreadSurface& tread,
                    const SolverSettings& settings,
                    SolverCounts& counts,
                    const EquilibriumOptions& options = {});

  /// Brings `state` into equilibrium under pressure and contact (null: off the ground). A Failure
  /// names `step`, the residual and the worst element; `state` is then unchanged.
  Status solve(const RingElements& elements,
               AssembledState& state,
               double pressure,
               const TreadContact* contact,
               const std::string& step);

  /// Moves the ground pose by pose, from the equilibrium `state`, and computes each pose on the
  /// tire linearized at this state. Afterwards `contact` starts from the last pose. Returns false
  /// if the linearized tire is not positive definite on that ground.
  bool follow(const RingElements& elements,
              const AssembledState& state,
              double pressure,
              TreadContact& contact,
              const std::vector<GroundPose>& poses);

  /// Sets the force norm to which `tolerance` is relative: that of the pressure on the undeformed
  /// tire, N.
  void set_reference(double force) { reference_ = force; }
  /// Must be called if the tire's materials changed. The factorization then belongs to another
  /// matrix, so it is only a poor preconditioner.
  void forget_factor() { factor_.forget(); }
  /// Frees the memory of the factorization.
  void release() { factor_.release(); }
  /// Must be called if the elements changed, because the forces stored for the last state are then
  /// invalid.
  void forget_forces() { balance_.forget(); }

  /// Solves x <- K^-1 x with the present factorization as preconditioner, until the residual is
  /// `enough` times x. K is the tangent, ground included, near the equilibrium with which solve()
  /// ended. Returns false and leaves x unchanged if the factorization differs too much from K.
  bool solve_nearby(const numerics::SymmetricMatrix& K, double enough, Eigen::VectorXd& x) {
    return factor_.solve_nearby(K, enough, x);
  }

  const RingAssembly& assembly() const { return balance_.assembly(); }
  /// Elimination order of the matrix pattern, including the ground's entries, for callers that
  /// factorize such tangents.
  const std::shared_ptr<const numerics::Elimination>& elimination() const { return elimination_; }

 private:
  /// Residual below which a state counts as an equilibrium, N.
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
  AssembledState trial_;  // state at the end of a step that may still be rejected
};

}  // namespace latsch::fe_tire
