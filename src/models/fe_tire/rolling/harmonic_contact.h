// SPDX-License-Identifier: Apache-2.0
// Friction of a surface that rolls, for small harmonic motions about a steady state.
//
// Material at point k was at point k - 1 the time Delta t_k before, so that (F.1) in time is
//   t_k(t) = t'_k of t_{k-1}(t - Delta t_k) and x_k(t) - x_{k-1}(t - Delta t_k),
// and for motions dx e^(i omega t), with the derivatives of GripLink and e_k = exp(-i omega Delta
// t_k),
//   dt_k = by_before e_k dt_{k-1} + by_step (dx_k - e_k dx_{k-1}) + by_share dshare_k + by_p dp_k
//                                                                                             (F.3)
// Points that stick go on sticking and sliding ones go on sliding. At omega = 0 it is the tangent
// of (F.1). dx is the motion of points relative to the ground. On flat ground.
#pragma once

#include <Eigen/Core>
#include <functional>

#include "models/fe_tire/rolling/tread_body.h"

namespace latsch::fe_tire {

class HarmonicContact {
 public:
  /// All must outlive this object. `tractions` has links.
  HarmonicContact(const TreadBody& body, const RollingInput& input, const GripTractions& tractions)
      : body_(body), input_(input), tractions_(tractions) {}

  /// Returns the derivative [rows x rows] of the ground's forces on the body's rows, in the
  /// ground's axes, N/m.
  Eigen::MatrixXcd tangent(double omega) const;
  /// Returns the ground's forces [rows x motions] by motions of all points relative to the ground,
  /// [3 x points] each.
  Eigen::MatrixXcd forces_by(double omega, const std::vector<Eigen::Matrix3Xcd>& moved) const;
  /// Returns the changes of force, N, at each point [3 x points] if rows move by q and all points
  /// by `moved` besides.
  Eigen::Matrix3Xcd point_forces(double omega,
                                 const Eigen::VectorXcd& q,
                                 const Eigen::Matrix3Xcd& moved) const;

 private:
  using Motion = std::function<Eigen::Matrix3Xcd(int section, int point)>;
  using Take = std::function<void(int section, int point, const Eigen::Matrix3Xcd& force)>;
  void follow(double omega, const Motion& motion, const Take& take) const;

  const TreadBody& body_;
  const RollingInput& input_;
  const GripTractions& tractions_;
};

}  // namespace latsch::fe_tire
