// SPDX-License-Identifier: Apache-2.0
// The contact of a tire that does not roll steadily: the tread of a tire that is linear within a
// step (tread_flexibility.h) on the ground below, with friction in time (F.5) of tread_past.h.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/result.h"
#include "models/fe_tire/grip/tread_past.h"
#include "models/fe_tire/rolling/rolling_case.h"
#include "models/fe_tire/rolling/tread_body.h"
#include "models/fe_tire/rolling/tread_roller.h"

namespace latsch::fe_tire {

class TreadInTime {
 public:
  /// The contact at the end of a step. Vectors at the nodes have three numbers a node of the tread,
  /// in the axes of its unknowns.
  struct Found {
    RollingCase of;     // with the height found
    Eigen::VectorXd d;  // m, decrease of the displacements
    Eigen::VectorXd c;  // N, the ground's forces
    RollingForces forces;
    std::vector<RollingPatchPoint> patch;
    TreadPast::Instant instant;
  };

  /// Both must outlive the patch.
  TreadInTime(const TreadSurface& tread, const TreadLines& lines) : tread_(tread), lines_(lines) {}

  /// Sets the flexibility F of the tread in a step [3 nodes x 3 nodes], m/N.
  void set(Eigen::MatrixXf F) { F_ = std::move(F); }
  bool is_set() const { return F_.size() > 0; }
  void forget() { F_.resize(0, 0); }
  /// Begins a step, of which the active sets are limited in number.
  void begin() { spent_ = 0; }

  /// Finds the forces c of the ground and d = F (g - c), where g are those that the tread's nodes
  /// carry at the displacements u [3 x nodes]. The spin is that of the case, and so is the height,
  /// unless the case has a load. `states`: of all points of the tread; the start, then those found.
  /// `load`, N: the size of the ground's forces. `enough`: accepted residual relative to it, which
  /// single precision limits to 1e-6 of the change of the forces. `passes` counts solutions.
  /// `settled`: with less residual, relative to the load, g itself is the contact, at the places of
  /// the points on the ground that belong to u, and nothing is solved. A Failure says why there is
  /// no contact.
  Result<Found> solve(const RollingCase& of,
                      const Eigen::Matrix3Xd& u,
                      const Eigen::VectorXd& g,
                      double load,
                      double enough,
                      GripState& states,
                      int& passes,
                      const PassingMoment& moment,
                      double settled = 0.0);

 private:
  static constexpr int kMostSets = 1500;  // limit of the work for one step; most need some 5

  const TreadSurface& tread_;
  const TreadLines& lines_;
  Eigen::MatrixXf F_;
  int spent_ = 0;
};

}  // namespace latsch::fe_tire
