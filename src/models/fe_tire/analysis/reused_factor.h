// SPDX-License-Identifier: Apache-2.0
// Factorization of the ring's tangent that is reused at later states until it has become too
// inaccurate.
//
// A factorization costs as much as some twenty solves with it. At a later state it still gives a
// first direction, with the ground treated separately and exactly (linear_tire.h), and it
// preconditions conjugate gradients on the tangent of that state. The number of iterations that
// these need is called the age of the factorization. It is kept in single precision, which halves
// memory traffic and time.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "models/fe_tire/analysis/linear_tire.h"
#include "models/fe_tire/analysis/solver_settings.h"
#include "numerics/sparse/conjugate_gradients.h"
#include "numerics/sparse/elimination.h"

namespace latsch::fe_tire {

struct ReusedFactorOptions {
  /// Largest number of iterations of a correction, at least 1. So many iterations cost as much as a
  /// new factorization. A larger number keeps old factorizations longer.
  int iterations_worth_a_factor = 20;
  /// Age, in iterations, above which the factorization is not used for the next tangent, from 0 to
  /// `iterations_worth_a_factor`. A smaller limit causes more factorizations.
  int stale_age = 9;
  /// Largest number of iterations of a solution to full accuracy, at least 1. A factorization of
  /// the matrix itself with three solves costs as much as 12 to 17 iterations. An iteration that
  /// has come this far usually converges before it reaches this limit.
  int iterations_worth_an_own_factor = 24;
  /// First shift of an indefinite tangent along its diagonal, relative to the largest diagonal
  /// entry, and the ratio of successive shifts, above 1. Larger values find a definite tangent with
  /// fewer factorizations, but shorten the step more.
  double first_shift = 1e-5, shift_growth = 4.0;
  /// The first shift of the next tangent of the same equilibrium is this share of the last one,
  /// from 0 to 1.
  double shift_memory = 0.25;
  /// Largest shift, relative to the largest diagonal entry. If it is exceeded, the tangent counts
  /// as unusable.
  double largest_shift = 1e3;
};

/// The linearized equation of one iteration, (L.1) of linear_tire.h, about the state x.
struct LinearizedRing {
  numerics::SymmetricMatrix& K;  // tangent of elements and pressure, N/m
  const TreadContact* contact;   // null: the tire is off the ground
  const Eigen::VectorXd& x;      // state
  const Eigen::VectorXd& f;      // residual including the ground's forces, N
};

class ReusedFactor {
 public:
  /// Treatment of a tangent that is not positive definite: shift it, or return false.
  enum class IfIndefinite { shift, give_up };
  /// Treatment of a correction that has not converged: use it, or return false.
  enum class IfSlow { take_it, give_up };

  /// The object adds its work to `counts`. `tread` and `counts` must outlive this object.
  ReusedFactor(const numerics::SymmetricPattern& pattern,
               const numerics::Elimination& elimination,
               const TreadSurface& tread,
               const ReusedFactorOptions& options,
               SolverCounts& counts);

  /// Starts the search for another equilibrium. The factorization is kept if it can be used with
  /// this ground.
  void begin(const TreadContact* contact);
  /// Returns true if there is a factorization.
  bool exists() const { return age_.has_value(); }
  /// Returns true if the factorization is too old for another tangent. There must be one.
  bool is_stale() const { return *age_ > options_.stale_age; }
  /// Discards the factorization, because it belongs to a state or to materials that differ too
  /// much.
  void forget() { age_.reset(); }
  /// Discards the factorization and frees its memory.
  void release();

  /// Factorizes K without a shift. Returns false if K is not positive definite.
  bool factorize(const numerics::SymmetricMatrix& K, const TreadContact* contact);
  /// Computes the direction d with a new factorization, until the residual of the linear equation
  /// is `tolerance` if the iterations reach it. An indefinite K is shifted along its diagonal until
  /// it is positive definite, so that d is a descent direction. Returns false if no shift helps, as
  /// for values that are not numbers, or if indefinite tangents are not to be shifted.
  bool renew(const LinearizedRing& at,
             double tolerance,
             IfIndefinite if_indefinite,
             Eigen::VectorXd& d);
  /// Computes a first direction d with the present ground and the tangent that was factorized.
  /// Returns false if tire and ground together are not positive definite.
  bool find_first(const LinearizedRing& at, Eigen::VectorXd& d);
  /// Corrects d until the residual of the linear equation with the tangent K is `tolerance`. It
  /// uses conjugate gradients or, if points slide and the tangent is not symmetric, minimal
  /// residuals. Returns false if this takes too many iterations.
  bool correct(const LinearizedRing& at, double tolerance, IfSlow if_slow, Eigen::VectorXd& d);
  /// Moves the ground along `poses` on the linearized tire (LinearTire::follow). If the linearized
  /// tire is not positive definite there, discards the factorization and returns false.
  bool follow(const numerics::SymmetricMatrix& K,
              TreadContact& contact,
              const Eigen::VectorXd& x,
              const Eigen::VectorXd& g,
              const std::vector<GroundPose>& poses);
  /// Solves x <- K^-1 x until the residual is `enough` times x. K contains the ground's stiffness
  /// of the last step. Returns false and leaves x unchanged if the factorization differs too much
  /// from K.
  bool solve_nearby(const numerics::SymmetricMatrix& K, double enough, Eigen::VectorXd& x);

 private:
  ReusedFactorOptions options_;
  SolverCounts& counts_;
  LinearTire tire_;
  // Iterations of the last correction; not set if there is no factorization.
  std::optional<int> age_;
  double last_shift_ = 0.0;  // shift of the last indefinite tangent of this equilibrium, N/m
  numerics::ConjugateGradients cg_;
  Eigen::VectorXd r_, e_;  // residual of the linear equation; correction of the direction
};

}  // namespace latsch::fe_tire
