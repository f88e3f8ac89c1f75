// SPDX-License-Identifier: Apache-2.0
// Equilibrium of an elastic body with the friction of rolling, (F.1) of rolling_grip.h.
//
// The body has unknowns q, of which the positions and pressures of its points follow, and the
// residual R(q) = internal forces - forces of p and t. Newton's method on (F.1) by itself cycles
// without end once epsilon_t times the distance of points exceeds the body's stiffness, because
// the law then turns tractions around within one step. With states of the points, a traction that
// slides keeps its size, and one that sticks is not limited, until the step is done:
//
//   repeat:
//     one step of Newton's method on R(q) = 0 with the states as they are; the first one keeps the
//       directions of sliding points, the others turn them, with a line search on |R|
//     if |R| is small: points that stick beyond mu p slide, and points that slide along their
//       traction, or whose trial traction is below mu p, stick
//
// From a neighboring state this ends after two to ten steps. If it does not, an active set starts
// again and changes more carefully:
//
//   repeat:
//     solve R(q) = 0 with the states as they are: sliding points first in the directions of the
//       last state, then with a line search on |R|
//     points that stick beyond mu p slide             -> again
//     nothing was released: points that slide along their traction, or whose trial traction is
//       below mu p, stick                             -> again
//
// A point that returns too often is left sliding.
#pragma once

#include <Eigen/Core>
#include <string>

#include "base/result.h"
#include "models/fe_tire/grip/rolling_grip.h"

namespace latsch::fe_tire {

/// An elastic body whose points roll over the ground.
class RollingBody {
 public:
  virtual ~RollingBody() = default;
  /// Returns positions and pressures of the points at q.
  virtual RollingInput input(const Eigen::VectorXd& q) const = 0;
  /// Returns the residual at q, N: internal forces less those of the ground with these tractions.
  virtual Eigen::VectorXd residual(const Eigen::VectorXd& q,
                                   const RollingInput& input,
                                   const GripTractions& tractions) const = 0;
  /// Solves J dq = R, where J is the derivative of the residual, tractions included
  /// (GripTractions::by). Returns false if J is singular.
  virtual bool solve(const Eigen::VectorXd& q,
                     const RollingInput& input,
                     const GripTractions& tractions,
                     const Eigen::VectorXd& R,
                     Eigen::VectorXd& dq) = 0;
  /// Returns the size of the ground's forces, N, to which tolerances are relative.
  virtual double force_scale() const = 0;
};

struct RollingContactOptions {
  /// Residual at which a state is an equilibrium, relative to the ground's forces. Smaller ones
  /// cost an iteration more.
  double tolerance = 1e-10;
  /// Residual that is accepted if it does not fall any more, relative to the same forces: rounding
  /// of positions times a stiff penalty.
  double rounding = 1e-7;
  /// Share of mu p by which a sticking point may exceed it; rounding has to be smaller.
  double excess = 1e-9;
  int most_at_once = 40;  // largest number of steps that change states at once
  int most_parts = 3;     // largest number of halvings of such a step
  int most_left = 0;      // number of points that may change their states after the last one
  /// Residual below which these change states, relative to the ground's forces.
  double nearby = 0.3;
  /// False: if they do not settle, the search ends.
  bool is_careful = true;
  int most_passes = 100;     // largest number of active sets
  int most_iterations = 40;  // largest number of Newton iterations a pass
  int most_returns = 12;     // largest number of returns of a point to sticking
  int most_halvings = 12;    // largest number of halvings of a Newton step
  double softer = 0.03;      // share of the penalty of a second start, if the first one fails
};

/// The equilibrium found, and the work that it took.
struct RollingContactState {
  Eigen::VectorXd q;
  RollingInput input;
  GripState state{0};
  GripTractions tractions;
  int passes = 0, solves = 0;
};

/// Finds the equilibrium from `q` and the states `from`. A Failure says how many points neither
/// stick nor slide, or what the residual is.
Result<RollingContactState> roll(RollingBody& body,
                                 const RollingGrip& grip,
                                 const Eigen::VectorXd& q,
                                 const GripState& from,
                                 const RollingContactOptions& options = {});

}  // namespace latsch::fe_tire
