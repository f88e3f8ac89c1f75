// SPDX-License-Identifier: Apache-2.0
// Inertia of a tire that vibrates while its material spins through a mesh that stands: (W.1) with a
// speed Omega that may change, at all nodes, those of the rim included.
//
//   f = M a + Omega (G' - G'^T) v - Omega^2 (w_0 + W u) + Omega' G' x                         (V.3)
//
// where x = X + u, v = du/dt, a = d2u/dt2 of places of the mesh in the wheel's axes, and M, G', W
// and w_0 = W X are those of spin.h. Since f holds the forces at the nodes of the rim, too, the
// force and the moment that the whole tire's inertia needs are its sums, and the force on the hub
// is the ground's force less these sums.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/fe_tire/ring/ring_elements.h"

namespace latsch::fe_tire {

class MovingInertia {
 public:
  /// Keeps a reference to the ring of the elements.
  explicit MovingInertia(const RingElements& elements);

  /// A motion of the nodes [3 x nodes] in sector frames, and of the spin.
  struct Motion {
    const Eigen::Matrix3Xd& u;  // m
    const Eigen::Matrix3Xd& v;  // m/s
    const Eigen::Matrix3Xd& a;  // m/s^2
    double spin = 0.0;          // rad/s, Omega
    double spin_rate = 0.0;     // rad/s^2, Omega'
  };
  struct Forces {
    Eigen::Matrix3Xd at_nodes;  // N, [3 x nodes] in sector frames
    Eigen::Vector3d force;      // N, their sum in the wheel's axes
    Eigen::Vector3d moment;     // N m, about the wheel center, in the wheel's axes
  };
  Forces forces(const Motion& motion) const;

  /// Returns twice the kinetic energy of the vibration, v M v, J.
  double twice_kinetic(const Eigen::Matrix3Xd& v) const;

 private:
  /// Inertia of one element, the same in each direction.
  struct Scalars {
    Matrix8 M, G, W;
  };
  Eigen::Matrix3Xd in_wheel_axes(const Eigen::Matrix3Xd& of) const;

  const Ring& ring_;
  std::vector<std::vector<int>> sectors_;       // [width]
  std::vector<std::vector<Scalars>> of_width_;  // [width][section element]
  std::vector<Eigen::Matrix3d> frames_;  // turns from the frame of a plane to the wheel's axes
  Eigen::Matrix3Xd X_;                   // m, places of all nodes in the wheel's axes
};

}  // namespace latsch::fe_tire
