// SPDX-License-Identifier: Apache-2.0
// The wrenches of one Force::LinearBushing between two bodies far from rest and in motion.
#pragma once

namespace oracle {

/// A row for each of a few places and speeds, chosen once at random. Both bodies have their origins
/// at zero at rest. In the ground's axes, SI: the bushing's point at rest; of both bodies travel of
/// the origin, rotation vector, velocity of the origin, angular velocity; stiffness and damping;
/// force and moment about the origin on both.
void print_bushing_wrenches();

}  // namespace oracle
