// SPDX-License-Identifier: Apache-2.0
// Ply steer. The cords of a belt's two working plies cross at equal angles, but not at equal
// distances from the surface about which it bends: bent, it twists as well. D16 of a laminate joins
// its bending moment and its twist [e.g. Jones, Mechanics of Composite Materials]. In the ring it
// also stands for what crossed plies do by B16, bending with shear in their plane, which a
// chain of nodes has not. Positive where a belt that is flattened and free turns its sections, from
// segment to segment in the direction of the nodes, to smaller ψ; the other way of crossing the
// plies changes the sign. Beside (3) and (5) the belt has the energy
//
//   (D16/L0^2) (s - s_0) (ψ' + ζ u' s/L0^2)                                                    (32)
//
// by Simpson's rule, at the knots too, where ζ is that of the knots. With D16^2 <= EI GJ all three
// together are never negative: twist at the knots is never more than that in the middles. In the
// patch sections lean to one side before the middle and to the other behind it: tips that stick
// from front to rear are sheared as by a slip angle.
//
// Node by node, not in kernels: seldom asked for.
#pragma once

#include "models/ring_tire/belt/belt.h"

namespace latsch::ring_tire {

/// += the force of (32), nodes at their places `at`; with the damping (30) where their rates are
/// given.
void add_ply_force(const BeltLaw& law, const RimRows& at, const RimRows* rate, RimRows& force);

/// K += scale * the slope of it, as find_stiffness() of belt.h: strains are stressed by one law and
/// stretch another.
void add_ply_stiffness(const BeltLaw& stress,
                       const BeltLaw& stretch,
                       const RimRows& at,
                       double scale,
                       StiffnessRows& K);

}  // namespace latsch::ring_tire
