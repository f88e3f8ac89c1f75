// SPDX-License-Identifier: Apache-2.0
// Newton's method on the ring with a factorization that is reused although it is of an earlier
// state.
//
// A factorization of the tangent costs as much as some twenty solves with it. So one factorization
// serves several Newton iterations and load steps: it gives a first direction, with the ground
// treated separately and exactly (linear_tire.h), and preconditions conjugate gradients on the
// current tangent. It is renewed when they become slow:
//
//   while |f(x)| > tolerance:
//     d   <- K(x)^-1 f(x), or the solution of (L.1), with a factor of K at an earlier state
//     x   <- x - s d       with s from a line search on d . f
//
// The factor is kept in single precision: half the memory traffic, half the time. A tangent that is
// not positive definite (long steps cause this) is shifted along its diagonal until it is.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "models/fe_tire/analysis/linear_tire.h"
#include "models/fe_tire/analysis/ring_assembly.h"
#include "models/fe_tire/analysis/solver_settings.h"
#include "numerics/sparse/conjugate_gradients.h"
#include "numerics/sparse/elimination.h"

namespace latsch::fe_tire {

class EquilibriumSolver {
 public:
  EquilibriumSolver(const RingUnknowns& unknowns,
                    const TreadSurface& tread,
                    const SolverSettings& settings);

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
  void forget_factor() { has_factor_ = false; }
  /// Frees the factor's memory.
  void release() {
    forget_factor();
    tire_.release();
  }
  /// Called if the elements changed: the forces stored for the last state are then invalid.
  void forget_forces() { elements_ = nullptr; }

  /// Solves x <- K^-1 x by the factor at hand, until the residual is `enough` of x. K is the
  /// tangent, ground included, about the equilibrium with which solve() ended. Returns false, with
  /// x unchanged, if the factor is too far off for that.
  bool solve_nearby(const numerics::SymmetricMatrix& K, double enough, Eigen::VectorXd& x);

  const RingAssembly& assembly() const { return assembly_; }
  /// Elimination order of the pattern, the ground's part included, for callers that factorize such
  /// tangents.
  const std::shared_ptr<const numerics::Elimination>& elimination() const { return elimination_; }
  /// Sets the counts to which the solver's work is added from now on. They must outlive the solver.
  void count_in(SolverCounts& counts) { counts_ = &counts; }

 private:
  double linear_tolerance(double ratio) const;
  void polish(AssembledState& state);
  bool assemble(AssembledState& state, bool with_tangent);
  bool begin(AssembledState& state, const RingElements& elements, double pressure);
  void add_contact(const AssembledState& state);
  bool renew_factor(const AssembledState& state, double tolerance);
  bool factorize();
  bool start(const AssembledState& state);
  bool find_direction(AssembledState& state, double tolerance);
  bool correct(double tolerance, bool may_give_up);
  bool line_search(AssembledState& state, bool wants_tangent);
  Failure failure(const std::string& step, const std::string& what) const;
  std::string worst_place() const;

  SolverSettings settings_;
  RingAssembly assembly_;
  const TreadSurface& tread_;
  numerics::SymmetricMatrix K_;
  std::shared_ptr<const numerics::Elimination> elimination_;
  LinearTire tire_;
  numerics::ConjugateGradients cg_;
  SolverCounts own_counts_;
  SolverCounts* counts_ = &own_counts_;

  // State of the equilibrium being solved.
  const RingElements* elements_ = nullptr;
  const TreadContact* contact_ = nullptr;
  double pressure_ = 0.0;
  double reference_ = 0.0;
  double shift_ = 0.0;     // on the diagonal of its last indefinite tangent, N/m
  double previous_ = 0.0;  // norm of the residual one iteration before
  bool has_factor_ = false;
  bool has_tangent_ = false;    // K_ is the tangent at the state of f_
  bool knows_tangent_ = false;  // K_ is the tangent at some state of this equilibrium's search
  bool is_first_ = false;       // the state is the result of the first step
  int last_cg_iterations_ = 0;
  int failed_element_ = -1;
  Eigen::VectorXd f_, d_, r_, e_;
  AssembledState trial_;
  // Forces of elements and pressure, and the state at which they were computed.
  Eigen::VectorXd g_;
  AssembledState known_;
};

}  // namespace latsch::fe_tire
