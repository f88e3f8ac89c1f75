// SPDX-License-Identifier: Apache-2.0
// The wrenches of one Force::LinearBushing between two bodies far from rest and in motion.
#pragma once

namespace oracle {

/// A row for each of a few places and speeds, all numbers of it, chosen once at random: of bodies
/// a and b their origins at rest 0, the bushing's point at rest, travel of the origin, rotation
/// vector, velocity of the origin, angular velocity; stiffness and damping of the six axes; force
/// and moment about the origin on both. SI, in the ground's axes.
void print_bushing_wrenches();

}  // namespace oracle
