// SPDX-License-Identifier: Apache-2.0
// Small changes of a steady state. With R of (R.1), rolling_tire.h, the condition of the load and
// that of the drive, each of which may be absent,
//   R(x, h, Omega; p) = 0:   [dR/dx dR/dh dR/dOmega] d(x, h, Omega)/dp = -dR/dp               (R.3)
// K is eliminated down to the nodes below which the ground is, as in linear_roller.h, and what is
// left is solved there with the Jacobian of the rolling patch (tread_tangent.cpp). The factor of K
// has single precision, so a solution is corrected by its residual.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <utility>

#include "models/fe_tire/rolling/linear_roller.h"

namespace latsch::fe_tire {

class RollingTangent {
 public:
  /// About the state x of a case; `K`: the tangent that `roller` has factorized there. `of`: height
  /// and spin follow from load and drive where these are set, and are held otherwise. All must
  /// outlive the object.
  RollingTangent(LinearRoller& roller,
                 const numerics::SymmetricMatrix& K,
                 const RollingCase& of,
                 const Eigen::VectorXd& x,
                 const GripState& states);

  /// Returns how the patch's unknowns, the rise and the relative change of the spin, answer to
  /// forces `residual`, N, on all unknowns, to forces `of_ground` on the patch's unknowns (as
  /// residual() of the body returns them), and to a relative change of a spin that is held.
  Eigen::VectorXd motion(const Eigen::VectorXd& residual,
                         const Eigen::VectorXd& of_ground,
                         double spin);
  /// Number of the patch's unknowns.
  int size() const { return body_.size(); }
  double rise(const Eigen::VectorXd& q) const { return body_.rise(q); }
  double spin_change(const Eigen::VectorXd& q) const { return body_.spin_change(q); }
  /// Returns the residual on the patch's unknowns with another friction.
  Eigen::VectorXd residual_with(const RollingFriction& friction) const;
  /// Returns the forces if the patch's unknowns are q and the friction is this one.
  RollingForces forces(const Eigen::VectorXd& q, const RollingFriction& friction) const;

 private:
  Eigen::VectorXd at_unknowns(const Eigen::VectorXd& c, Eigen::Index size) const;
  RollingContactState contact(const Eigen::VectorXd& q,
                              const RollingFriction& friction,
                              bool with_links) const;

  LinearRoller& roller_;
  const numerics::SymmetricMatrix& K_;
  RollingCase of_;
  RollingSurface surface_;
  TreadBody body_;
  GripState states_;
  Eigen::MatrixXd forces_by_;  // derivative of the residual on rows by all unknowns of the patch
  Eigen::PartialPivLU<Eigen::MatrixXd> J_;
};

}  // namespace latsch::fe_tire
