// SPDX-License-Identifier: Apache-2.0
// The nodes of the tread, to which the rest of a linear tire is condensed, on the ground below:
//
//   g - S d = c(u - d)                                                                       (R.2)
// d: decrease of the nodes' displacements u, g: forces that they carry at u, c: those of the
// ground. S is eliminated further down to the nodes below which the ground is (condensed_tire.h).
// There the contact with friction is solved by the active set of rolling_contact.h, together with
// the height that follows from a load and the spin that follows from a drive.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/result.h"
#include "models/fe_tire/analysis/condensed_tire.h"
#include "models/fe_tire/grip/tread_past.h"
#include "models/fe_tire/rolling/rolling_case.h"
#include "models/fe_tire/rolling/tread_body.h"

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
/// Gives the listed points among all the states that were found; others have none.
void put_back(const RollingContactState& found, const std::vector<int>& points, GripState& all);
/// Returns the limits of the search for a contact of `points` points whose residual is `enough`,
/// relative to the size of the ground's forces.
RollingContactOptions search_limits(double enough, int points);
/// Returns the contact of a tread that touches nothing.
RollingContactState off_ground(const TreadBody& body);
/// Returns the instant of all points of the tread from positions and tractions of the listed ones.
TreadPast::Instant instant_of(const TreadBody& body,
                              const Eigen::Matrix3Xd& x,
                              const Eigen::Matrix2Xd& t);

class TreadRoller {
 public:
  /// The state that solves (R.2). Vectors at the nodes have three numbers a node of the tread, in
  /// the axes of its unknowns.
  struct Found {
    RollingCase of;     // with the height and the spin found
    Eigen::VectorXd d;  // m, decrease of the displacements
    Eigen::VectorXd c;  // N, the ground's forces
    RollingForces forces;
    std::vector<RollingPatchPoint> patch;
    TreadPast::Instant instant;  // state of the tread, if the tire does not roll steadily
  };

  /// Both must outlive the roller. `near`: height over the ground up to which points take part, m.
  TreadRoller(const TreadSurface& tread, const TreadLines& lines, double near = kNearPatch)
      : tread_(tread), lines_(lines), near_(near) {}

  /// Sets S, symmetric, [3 nodes x 3 nodes].
  void set(Eigen::MatrixXd S);
  const Eigen::MatrixXd& stiffness() const { return S_; }
  void forget() { rows_.clear(); }
  /// Begins a new state, whose active sets are limited in number.
  void begin() { spent_ = 0; }
  /// Careful: a contact that does not settle at once is searched for by active sets, too, which
  /// takes ten times as long.
  void be_careful(bool careful) { is_careful_ = careful; }
  /// True if they are used up: no part of a path succeeds any more.
  bool is_spent() const { return spent_ > kMostSets; }

  /// Solves (R.2) about the displacements u [3 x nodes, axes of the unknowns] with the forces g.
  /// `states`: of all points of the tread; the start, then those found. `load`, N: the size of the
  /// ground's forces. `enough`: accepted residual, load and drive included, relative to it.
  /// `passes` counts active sets. `moment`: none if the tire rolls steadily.
  Result<Found> solve(const RollingCase& of,
                      const Eigen::Matrix3Xd& u,
                      Eigen::VectorXd g,
                      double load,
                      double enough,
                      GripState& states,
                      int& passes,
                      const PassingMoment* moment = nullptr);
  /// Returns the instant of the tread in a steady state with the displacements u.
  TreadPast::Instant instant(const RollingCase& of, const Eigen::Matrix3Xd& u) const;

 private:
  friend class RollingTangent;
  static constexpr int kMostSets = 1500;  // limit of the work for one state; most need some 50
  bool condense_for(TreadBody& body);
  Eigen::VectorXd expand(const TreadBody& body, const Eigen::VectorXd& q) const;

  const TreadSurface& tread_;
  const TreadLines& lines_;
  double near_;
  Eigen::MatrixXd S_;
  CondensedTire condensed_;
  std::vector<int> rows_;  // those of condensed_; empty: none
  Eigen::VectorXd nodes_;  // g
  int spent_ = 0;
  bool is_careful_ = true;
};

}  // namespace latsch::fe_tire
