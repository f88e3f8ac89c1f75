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
//
// A velocity v e^(i omega t) with which points move over the ground besides, as by a slip, adds
//   v Delta t_k phi_k,   phi_k = (1 - e_k)/(i omega Delta t_k)
// to the step of point k, which is the way of its material since it was at point k - 1. At omega =
// 0 a velocity is a slip that does not change. Where the wheel turns, a point that moves relative
// to the wheel comes over ground with another velocity, which is added.
#pragma once

#include <Eigen/Core>
#include <functional>

#include "models/fe_tire/rolling/tread_body.h"

namespace latsch::fe_tire {

/// A motion of all points relative to the ground, beside that of the body's rows.
struct PointMotion {
  Eigen::Matrix3Xcd moved;  // m, [3 x points], displacement
  /// m/s, [2 x points], along the ground, beside that of `moved`; that by which `moved` brings a
  /// point over ground with another velocity is a part of it.
  Eigen::Matrix2Xcd velocity;

  /// A motion of nothing.
  static PointMotion none(Eigen::Index points) {
    return {Eigen::Matrix3Xcd::Zero(3, points), Eigen::Matrix2Xcd::Zero(2, points)};
  }
};

class HarmonicContact {
 public:
  /// All must outlive this object. `tractions` has links.
  HarmonicContact(const TreadBody& body, const RollingInput& input, const GripTractions& tractions)
      : body_(body), input_(input), tractions_(tractions) {}

  /// Returns the derivative [rows x rows] of the ground's forces on the body's rows, in the
  /// ground's axes, N/m.
  Eigen::MatrixXcd tangent(double omega) const;
  /// Returns the ground's forces [rows x motions] by motions of all points relative to the ground.
  Eigen::MatrixXcd forces_by(double omega, const std::vector<PointMotion>& motions) const;
  /// Returns the changes of force, N, at each point [3 x points] if rows move by q and all points
  /// by `besides`.
  Eigen::Matrix3Xcd point_forces(double omega,
                                 const Eigen::VectorXcd& q,
                                 const PointMotion& besides) const;
  /// Returns the displacements of all points, m [3 x points], if rows move by q.
  Eigen::Matrix3Xcd displacements(const Eigen::VectorXcd& q) const;
  /// Returns forces on the body's rows, N, from forces at the points [3 x points].
  Eigen::VectorXcd at_rows(const Eigen::Matrix3Xcd& forces) const;
  /// Returns the stiffness [rows x rows] of springs at all points in contact, along x, y and z, N/m
  /// per m^2 of a point's area.
  Eigen::MatrixXd springs(const Eigen::Vector3d& stiffness) const;

 private:
  /// Motions of a point, one column for each that is followed: displacements relative to the wheel,
  /// and what PointMotion has besides. Parts without columns are 0.
  struct Motions {
    Eigen::Matrix3Xcd dx;
    Eigen::Matrix3Xcd besides = {};
    Eigen::Matrix2Xcd velocity = {};
  };
  using Motion = std::function<Motions(int section, int point)>;
  using Take = std::function<void(int section, int point, const Eigen::Matrix3Xcd& force)>;
  void follow(double omega, const Motion& motion, const Take& take) const;
  Eigen::RowVectorXd weights(int section, int point) const;

  const TreadBody& body_;
  const RollingInput& input_;
  const GripTractions& tractions_;
};

}  // namespace latsch::fe_tire
