// SPDX-License-Identifier: Apache-2.0
// Ply steer. The cords of a belt's two working plies cross at equal angles, but not at equal
// distances from the surface about which the belt bends. A belt that bends therefore twists as
// well. D16 of a laminate couples its bending moment and its twist [e.g. Jones, Mechanics of
// Composite Materials]. In the ring D16 also stands for B16 of crossed plies, bending with shear in
// their plane, which a chain of nodes does not have. D16 is positive if a belt that is flattened
// and free rotates its sections to smaller ψ from segment to segment in the direction of the nodes;
// the opposite crossing of the plies changes the sign. In addition to (3) and (5) the belt has the
// energy
//
//   (D16/L0^2) (s - s_0) (ψ' + ζ u' s/L0^2)                                                    (32)
//
// It uses Simpson's rule, at the knots too, with ζ of the knots. With D16^2 <= EI GJ the sum of the
// three energies is never negative: the twist at the knots is never more than that in the middles.
// In the patch sections lean to one side before the middle and to the other side behind it, so tips
// that stick from front to rear are sheared as by a slip angle.
//
// The code goes node by node and has no kernels, because it is rarely used.
#pragma once

#include "models/ring_tire/belt/belt.h"

namespace latsch::ring_tire {

/// Adds the force of (32) to `force` with nodes at the positions `at`, and its damping (30) if
/// their rates are given.
void add_ply_force(const BeltLaw& law, const RimRows& at, const RimRows* rate, RimRows& force);

/// Adds scale times minus the derivative of that force to K, as find_stiffness() of belt.h: one law
/// gives the stresses and another the stiffnesses of the strains.
void add_ply_stiffness(const BeltLaw& stress,
                       const BeltLaw& stretch,
                       const RimRows& at,
                       double scale,
                       StiffnessRows& K);

}  // namespace latsch::ring_tire
