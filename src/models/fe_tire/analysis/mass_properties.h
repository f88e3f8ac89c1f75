// SPDX-License-Identifier: Apache-2.0
// Mass and moments of inertia of the tire, rubber and cords, about the wheel's center.
//   m = sum M_ab,   I_spin = sum M_ab (x_a x_b + z_a z_b)
//   I_diametral = I_spin / 2 + sum M_ab y_a y_b
// M is the mass matrix used for vibrations (hex8.h), and x_a, y_a, z_a are the positions of the
// nodes in the inflated state; I is twice the kinetic energy of a rotation by 1 rad/s. y is the
// spin axis. The tire is rotationally periodic about it, so all diameters have the same moment; on
// a mesh without symmetry the mean over them is used.
//
// Rim and air are not included. The mass is that of a body of revolution; with S sectors I_spin is
// too small by 1/3 (pi/S)^2, 0.1 % for 60 sectors. Bricks between chords (a mesh without sectors,
// comparison elements) form a polygon, whose mass is too small by twice as much, and I_spin by
// three times as much.
#pragma once

#include <Eigen/Core>

#include "models/fe_tire/ring/ring_elements.h"

namespace latsch::fe_tire {

struct MassProperties {
  double mass = 0.0;                                   // kg
  double spin_inertia = 0.0, diametral_inertia = 0.0;  // kg m^2
};

/// Returns the mass properties of a tire with equally wide sectors that have equal displacements u
/// [3 x nodes_per_sector], in the sector frame, m.
MassProperties mass_properties(const RingElements& elements, const Eigen::Matrix3Xd& u);

}  // namespace latsch::fe_tire
