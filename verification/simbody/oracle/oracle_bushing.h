// SPDX-License-Identifier: Apache-2.0
// Prints the wrenches of one Force::LinearBushing between two moving bodies that are far from their
// rest positions.
#pragma once

namespace oracle {

/// Prints a row for each of a few positions and velocities, chosen once at random. The origins of
/// both bodies coincide with the ground's at rest. Columns, in the ground's axes, SI: the bushing's
/// point at rest; for both bodies the displacement of the origin, rotation vector, velocity of the
/// origin, angular velocity; stiffness and damping; force and moment about the origin on both.
void print_bushing_wrenches();

}  // namespace oracle
