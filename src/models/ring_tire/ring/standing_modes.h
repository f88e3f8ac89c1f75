// SPDX-License-Identifier: Apache-2.0
// Modes of the ring standing on the road with the rim fixed: (K - ω^2 M) φ = 0 for small vibrations
// about the equilibrium, in which tread blocks and friction elements of the sidewall stick. Damping
// and dynamic stiffening are computed by (21).
//
// A mode is named after those waves of the unloaded ring (ring_modes.h) that contain most of its
// kinetic energy. The contact splits their pairs into shapes symmetric and antisymmetric to the
// plane through the contact and the spin axis.
#pragma once

#include <vector>

#include "base/result.h"
#include "models/ring_tire/ring/ring_tire.h"

namespace latsch::ring_tire {

struct StandingMode {
  int n = 0;             // number of waves around the circumference
  bool lateral = false;  // true: lateral motion with torsion; false: motion in the plane of the rim
  char phase = ' ';      // 's' symmetric, 'a' antisymmetric; ' ': neither, or no node is lowest
  int order = 1;         // 1, 2, ... among modes of the same n, plane and phase, by frequency
  double share = 0.0;    // share of the mode's kinetic energy in these waves
  double frequency = 0.0;  // Hz, without damping
  double damping = 0.0;    // D, share of critical damping
  NodeValues shape;        // u_r, u_t, u_y (m) and ψ (rad) of every node for unit modal mass
};

/// Returns the `count` lowest modes of a tire that settle() has brought to equilibrium. Returns a
/// Failure if the equilibrium is unstable.
Result<std::vector<StandingMode>> standing_modes(const RingTire& tire, int count);

}  // namespace latsch::ring_tire
