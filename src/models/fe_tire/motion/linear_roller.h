// SPDX-License-Identifier: Apache-2.0
// The tire, linear about an iterate, that rolls on flat ground: the problem that each iteration of
// Newton's method on (R.1) of rolling_tire.h solves.
//
//   g - K d = c(u - d)                                                                       (R.2)
// K is eliminated down to the nodes of the tread, and these down to the nodes below which the
// ground is (condensed_tire.h). There the contact with friction is solved by the active set of
// rolling_contact.h. A height that follows from a load and a spin that follows from a drive are
// found around it, by Newton's method with Broyden's updates.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "base/result.h"
#include "models/fe_tire/analysis/condensed_tire.h"
#include "models/fe_tire/analysis/ring_assembly.h"
#include "models/fe_tire/motion/rolling_case.h"
#include "models/fe_tire/motion/tread_body.h"
#include "numerics/sparse/factorization.h"

namespace latsch::fe_tire {

class LinearRoller {
 public:
  /// The state that solves (R.2).
  struct Found {
    RollingCase of;     // with the height and the spin found
    bool is_balanced;   // false: load or drive ask for a height or a spin too far away for one step
    Eigen::VectorXd d;  // decrease of the unknowns
    Eigen::VectorXd c;  // the ground's forces on the unknowns, N
    RollingForces forces;
    std::vector<RollingPatchPoint> patch;
  };

  /// All must outlive the roller.
  LinearRoller(const RingAssembly& assembly, const TreadSurface& tread, const TreadLines& lines);

  /// Factorizes K. Returns false if it is not positive definite.
  bool factorize(const numerics::SymmetricMatrix& K);
  bool has_factor() const { return has_factor_; }
  void forget();
  /// Begins a new state, whose active sets are limited in number.
  void begin() { spent_ = 0; }
  /// True if they are used up: no part of a path succeeds any more.
  bool is_spent() const { return spent_ > kMostSets; }

  /// Solves (R.2) about the unknowns x with the forces g. `states`: of all points of the tread; the
  /// start, then those found. `load`, N: the size of the ground's forces. `enough`: accepted error
  /// of the load, relative, and of the drive, relative to load times height. `passes` counts active
  /// sets.
  Result<Found> solve(const RollingCase& of,
                      const Eigen::VectorXd& x,
                      const Eigen::VectorXd& g,
                      double load,
                      double enough,
                      GripState& states,
                      int& passes);

 private:
  static constexpr int kMostSets = 1500;  // limit of the work for one state; most need some 50
  struct Attempt {
    std::unique_ptr<TreadBody> body;
    RollingContactState contact;
    RollingForces forces;
    std::vector<RollingPatchPoint> patch;
    bool is_balanced = true;
  };
  Result<Attempt> stand(const RollingCase& of, GripState& states);
  Result<Attempt> balance(RollingCase& of, double enough, GripState& states);
  Eigen::MatrixXd slopes(const RollingCase& of, const Eigen::VectorXd& error, GripState states);
  Eigen::VectorXd errors(const RollingCase& of, const RollingForces& forces) const;
  bool condense_for(TreadBody& body);
  Eigen::VectorXd at_nodes(const Eigen::VectorXd& v) const;

  const TreadSurface& tread_;
  const TreadLines& lines_;
  numerics::Factorization factor_;
  bool has_factor_ = false;
  Eigen::MatrixXd S_;  // condensed to the tread's nodes
  CondensedTire condensed_;
  std::vector<int> rows_;  // those of condensed_; empty: none
  Eigen::VectorXd nodes_;  // right-hand side at the tread's nodes
  Eigen::Matrix3Xd u_;     // displacements of the tread's nodes at x
  Eigen::VectorXd q_;      // last solution on rows_, a start
  double load_ = 1.0;
  int passes_ = 0, spent_ = 0;
  Eigen::MatrixXd by_;  // derivative of the errors of load and drive with respect to what is
                        // found
};

}  // namespace latsch::fe_tire
