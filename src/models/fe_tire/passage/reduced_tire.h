// SPDX-License-Identifier: Apache-2.0
// The tire linear about a steady state, in few coordinates, for long ways in time and for cars.
//
//   u = u_0 + Phi q + [K^-1 - Phi (Phi' K Phi)^-1 Phi'] B (c - c_0)                           (V.8)
// Phi are shapes of unit mass of the tire off the ground that carries the stress of the steady
// state u_0 and spins (K_Omega): its modes up to `beyond` times the highest frequency that is
// wanted, and its static displacements under loads on the tread, one in each direction of every
// plane and each polynomial across up to the third degree. The ground's forces c on the nodes B of
// the tread act on them, and at once on what the shapes leave out of the static displacements. With
// c_0 of the steady state,
//   q'' + Omega G q' + K q + sum_r K_r sum_i y_ri = Phi' B (c - c_0)
//   y' + Omega D y + y/tau = beta (q' + Omega D q),   D = Phi' (G' - M [e x]) Phi             (V.9)
// K: the relaxed stiffness; K_r: the part of it to which the Prony terms (beta, tau) belong. D is
// the derivative along the flow of components that turn with the material, as stresses are carried
// (H.1), projected on the shapes. Contact and friction stay what they are.
//   [Residual flexibility: MacNeal, Computers & Structures 1 (1971) 581-601]
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/fe_tire/contact/tread_surface.h"
#include "models/fe_tire/history/free_vibrations.h"
#include "models/fe_tire/rolling/rolling_case.h"
#include "models/fe_tire/rolling/tread_lines.h"

namespace latsch::fe_tire {

struct ReductionSettings {
  double highest = 300.0;  // Hz, the highest frequency that is wanted
  double beyond = 1.25;    // modes are taken up to this multiple of it
};

/// Matrices of (V.8), (V.9). Forces at nodes of the tread are in the axes of their unknowns, three
/// a node; sums are force, N, and moment about the wheel center, N m, in the wheel's axes.
struct ReducedTire {
  using Sums = Eigen::Matrix<double, 6, Eigen::Dynamic>;

  // They belong to the RollingTransient that made the tire.
  const TreadSurface* tread;
  const TreadLines* lines;
  double reach;  // m, distance from the axle up to which the tread may touch

  RollingCase of;                        // the steady state
  Eigen::Matrix3Xd u;                    // m, displacements of the tread's nodes [3 x nodes]
  Eigen::VectorXd c;                     // N, forces of the ground on them
  Eigen::MatrixXd K, G, D;               // [shapes x shapes]
  std::vector<RelaxingStiffness> parts;  // relaxing parts of K
  Eigen::MatrixXd at_tread;              // Phi at the tread's nodes [3 nodes x shapes]
  Eigen::MatrixXd rest;                  // m/N, the bracket of (V.8) there [3 nodes x 3 nodes]

  /// Forces of the tire's inertia on the shapes, and its sums, by a change of the motion.
  struct Inertia {
    Eigen::MatrixXd on_shapes;  // [shapes x changes]
    Sums sums;                  // [6 x changes]
  };
  Sums by_q, by_rate, by_acceleration;  // sums of the shapes' motion at the spin of `of`
  Eigen::Vector<double, 6> steady;      // sums of the steady state
  Inertia spin;                         // change: Omega^2 - Omega_0^2
  Inertia spin_rate;                    // change: Omega'
  Inertia acceleration;                 // changes: acceleration of the wheel center, m/s^2
  Inertia turning, turning_rate;        // changes: rotation of the wheel's axes, rad/s, rad/s^2

  Eigen::Index shapes() const { return K.rows(); }
};

}  // namespace latsch::fe_tire
