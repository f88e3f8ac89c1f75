// SPDX-License-Identifier: Apache-2.0
// The wrenches of one Force::LinearBushing between two moving bodies far from rest.
#pragma once

namespace oracle {

/// Prints a row for each of a few places and speeds, chosen once at random. Both bodies have their
/// origins at zero at rest. Columns, in the ground's axes, SI: the bushing's point at rest; for
/// both bodies the travel of the origin, rotation vector, velocity of the origin, angular velocity;
/// stiffness and damping; force and moment about the origin on both.
void print_bushing_wrenches();

}  // namespace oracle
