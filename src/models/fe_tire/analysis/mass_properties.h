// SPDX-License-Identifier: Apache-2.0
// Mass and moments of inertia of the tire, rubber and cords, about the wheel's center.
//   m = sum M_ab,   I_spin = sum M_ab (x_a x_b + z_a z_b)
//   I_diametral = I_spin / 2 + sum M_ab y_a y_b
// with the mass M of the elements that vibrate (hex8.h) and their nodes where the state has them:
// twice the kinetic energy of a turn by 1 rad/s. y is the spin axis; about it the tire repeats, so
// all diameters have the same moment; of a mesh without symmetry it is the mean over them.
//
// Neither rim nor air. S sectors are the pieces of a polygon: of a body of revolution the mass is
// short by 2/3 (pi/S)^2 of itself, 0.2 % of 60 sectors, I_spin by half as much again.
#pragma once

#include <Eigen/Core>

#include "models/fe_tire/ring/ring_elements.h"

namespace latsch::fe_tire {

struct MassProperties {
  double mass = 0.0;                                   // kg
  double spin_inertia = 0.0, diametral_inertia = 0.0;  // kg m^2
};

/// Of sectors all equally wide, displaced alike: u [3 x nodes_per_sector], sector frame, m.
MassProperties mass_properties(const RingElements& elements, const Eigen::Matrix3Xd& u);

}  // namespace latsch::fe_tire
