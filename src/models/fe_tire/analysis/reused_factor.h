// SPDX-License-Identifier: Apache-2.0
// A factorization of the ring's tangent that serves later states until it has aged too much.
//
// A factorization costs as much as some twenty solves with it. At a later state the factor still
// gives a first direction, with the ground treated separately and exactly (linear_tire.h), and
// preconditions conjugate gradients on the tangent of that state. The number of iterations that
// these take is the age of the factor. The factor is kept in single precision: half the memory
// traffic, half the time.
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
  /// Most iterations of a correction, at least 1: the number that costs as much as a factorization.
  /// A larger number keeps old factors longer.
  int iterations_worth_a_factor = 20;
  /// Age above which the factor is too old for the next tangent, in iterations, from 0 to
  /// `iterations_worth_a_factor`. A smaller age factorizes more often.
  int stale_age = 9;
  /// Most iterations of a solution to the last digits, at least 1. A factorization of its own and
  /// three solves cost as much as 12 to 17 iterations; a solution that has come this far converges
  /// sooner than that.
  int iterations_worth_an_own_factor = 24;
  /// First shift of an indefinite tangent along its diagonal, relative to the largest diagonal
  /// entry, and factor from one shift to the next, above 1. Larger values find a definite tangent
  /// in fewer factorizations and shorten the step more.
  double first_shift = 1e-5, shift_growth = 4.0;
  /// Share of the last shift of the same equilibrium from which the next tangent's shift starts,
  /// from 0 to 1.
  double shift_memory = 0.25;
  /// Shift above which the tangent is given up, relative to the largest diagonal entry.
  double largest_shift = 1e3;
};

/// The linear equation of one iteration, (L.1) of linear_tire.h, about the state x.
struct LinearizedRing {
  numerics::SymmetricMatrix& K;  // tangent of elements and pressure, N/m
  const TreadContact* contact;   // null: off the ground
  const Eigen::VectorXd& x;      // state
  const Eigen::VectorXd& f;      // residual, ground included, N
};

class ReusedFactor {
 public:
  /// Says how to treat a tangent that is not positive definite.
  enum class IfIndefinite { shift, give_up };
  /// Says how to treat a correction that has not converged.
  enum class IfSlow { take_it, give_up };

  /// `tread` and `counts`, to which the work is added, must outlive this object.
  ReusedFactor(const numerics::SymmetricPattern& pattern,
               const numerics::Elimination& elimination,
               const TreadSurface& tread,
               const ReusedFactorOptions& options,
               SolverCounts& counts);

  /// Starts the search for another equilibrium: the factor stays if it can serve on that ground.
  void begin(const TreadContact* contact);
  /// True if there is a factor.
  bool exists() const { return age_.has_value(); }
  /// True if the factor is too old for another tangent; requires that there is one.
  bool is_stale() const { return *age_ > options_.stale_age; }
  /// Drops the factor: it belongs to a state or to values too far off.
  void forget() { age_.reset(); }
  /// Drops the factor and frees its memory.
  void release();

  /// Factorizes K as it is. Returns false if it is not positive definite.
  bool factorize(const numerics::SymmetricMatrix& K, const TreadContact* contact);
  /// Finds the direction d by a new factorization, to `tolerance` of the residual if the iterations
  /// reach it. An indefinite K is shifted along its diagonal until it is positive definite: d is a
  /// direction of descent in any case. Returns false if no shift helps, as with values that are not
  /// numbers, or if an indefinite tangent is given up.
  bool renew(const LinearizedRing& at,
             double tolerance,
             IfIndefinite if_indefinite,
             Eigen::VectorXd& d);
  /// Finds the direction d with the present ground and the factor's own tangent. Returns false if
  /// tire and ground together are not positive definite.
  bool find_first(const LinearizedRing& at, Eigen::VectorXd& d);
  /// Improves d to `tolerance` of the residual with the tangent K: by conjugate gradients on the
  /// residual, or by minimal residuals if something slides, because that tangent is not symmetric.
  /// Returns false if that takes too many iterations.
  bool correct(const LinearizedRing& at, double tolerance, IfSlow if_slow, Eigen::VectorXd& d);
  /// Moves along `poses` on the linear tire (LinearTire::follow). Drops the factor and returns
  /// false if the linear tire is not positive definite there.
  bool follow(const numerics::SymmetricMatrix& K,
              TreadContact& contact,
              const Eigen::VectorXd& x,
              const Eigen::VectorXd& g,
              const std::vector<GroundPose>& poses);
  /// Solves x <- K^-1 x, until the residual is `enough` of x, for a K that contains the ground of
  /// the last step. Returns false, with x unchanged, if the factor is too far off for that.
  bool solve_nearby(const numerics::SymmetricMatrix& K, double enough, Eigen::VectorXd& x);

 private:
  ReusedFactorOptions options_;
  SolverCounts& counts_;
  LinearTire tire_;
  std::optional<int> age_;   // iterations of the last correction; none: there is no factor
  double last_shift_ = 0.0;  // shift of the last indefinite tangent of this equilibrium, N/m
  numerics::ConjugateGradients cg_;
  Eigen::VectorXd r_, e_;  // residual of the equation, correction of the direction
};

}  // namespace latsch::fe_tire
