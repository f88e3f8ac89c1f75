// SPDX-License-Identifier: Apache-2.0
// The tire, linear about an iterate, that rolls on flat ground: the problem that each iteration of
// Newton's method on (R.1) of rolling_tire.h solves.
//
//   g - K d = c(u - d)                                                                       (R.2)
// K is eliminated down to the nodes of the tread, and these down to the nodes below which the
// ground is (condensed_tire.h). There the contact with friction is solved by the active set of
// rolling_contact.h, together with the height that follows from a load and the spin that follows
// from a drive. The factor of K is in single precision: g is not, and iterations converge to it.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "base/result.h"
#include "models/fe_tire/analysis/condensed_tire.h"
#include "models/fe_tire/analysis/ring_assembly.h"
#include "models/fe_tire/grip/tread_past.h"
#include "models/fe_tire/rolling/rolling_case.h"
#include "models/fe_tire/rolling/tread_body.h"
#include "numerics/sparse/factorization.h"

namespace latsch::fe_tire {

/// A moment of a tire that does not roll steadily.
struct PassingMoment {
  const TreadPast& past;               // its tread up to one step before
  double step;                         // s
  const FeltGround* ground = nullptr;  // none: the ground is smooth
  WheelPlace wheel = {};               // place of the wheel over the ground
};

/// Height over the ground up to which points take part in an iteration, m. A larger one costs
/// larger dense matrices, a smaller one more iterations.
inline constexpr double kNearPatch = 1.5e-3;

/// Returns the motion of the ground below the wheel of a case.
GroundMotion motion_of(const RollingCase& of);
/// Returns the states of some points among those of all.
GripState listed(const GripState& all, const std::vector<int>& points);

class LinearRoller {
 public:
  /// The state that solves (R.2).
  struct Found {
    RollingCase of;     // with the height and the spin found
    Eigen::VectorXd d;  // decrease of the unknowns
    Eigen::VectorXd c;  // the ground's forces on the unknowns, N
    RollingForces forces;
    std::vector<RollingPatchPoint> patch;
    TreadPast::Instant instant;  // state of the tread, if the tire does not roll steadily
  };

  /// All must outlive the roller.
  LinearRoller(const RingAssembly& assembly, const TreadSurface& tread, const TreadLines& lines);

  /// Factorizes K. Returns false if it is not positive definite.
  bool factorize(const numerics::SymmetricMatrix& K);
  bool has_factor() const { return has_factor_; }
  void forget();
  /// Begins a new state, whose active sets are limited in number.
  void begin() { spent_ = 0; }
  /// Careful: a contact that does not settle at once is searched for by active sets, too, which
  /// takes ten times as long.
  void be_careful(bool careful) { is_careful_ = careful; }
  /// True if they are used up: no part of a path succeeds any more.
  bool is_spent() const { return spent_ > kMostSets; }

  /// Solves (R.2) about the unknowns x with the forces g. `states`: of all points of the tread; the
  /// start, then those found. `load`, N: the size of the ground's forces. `enough`: accepted
  /// residual, load and drive included, relative to it. `passes` counts active
  /// sets. `moment`: none if the tire rolls steadily.
  Result<Found> solve(const RollingCase& of,
                      const Eigen::VectorXd& x,
                      const Eigen::VectorXd& g,
                      double load,
                      double enough,
                      GripState& states,
                      int& passes,
                      const PassingMoment* moment = nullptr);
  /// Returns the instant of the tread in a steady state with the unknowns x.
  TreadPast::Instant instant(const RollingCase& of, const Eigen::VectorXd& x) const;

 private:
  friend class RollingTangent;
  static constexpr int kMostSets = 1500;  // limit of the work for one state; most need some 50
  Eigen::VectorXd reduced(const Eigen::VectorXd& g);
  bool condense_for(TreadBody& body);
  void expand(const TreadBody& body, const Eigen::VectorXd& q, Eigen::VectorXd& d) const;
  Eigen::VectorXd forces_at_unknowns(const TreadBody& body,
                                     const Eigen::VectorXd& c,
                                     Eigen::Index size) const;
  Eigen::VectorXd at_nodes(const Eigen::VectorXd& v) const;

  const TreadSurface& tread_;
  const TreadLines& lines_;
  numerics::Factorization factor_;
  bool has_factor_ = false;
  Eigen::MatrixXd S_;  // condensed to the tread's nodes
  CondensedTire condensed_;
  std::vector<int> rows_;  // those of condensed_; empty: none
  Eigen::VectorXd nodes_;  // right-hand side at the tread's nodes
  int spent_ = 0;
  bool is_careful_ = true;
};

}  // namespace latsch::fe_tire
