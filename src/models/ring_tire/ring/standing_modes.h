// SPDX-License-Identifier: Apache-2.0
// Modes of the ring standing on the road with the rim fixed: (K - ω^2 M) φ = 0 for small vibrations
// about the equilibrium, in which blocks and friction in the sidewall stick. Damping and dynamic
// stiffening follow (21).
//
// A mode is named after the waves of the unloaded ring (ring_modes.h) that hold most of its kinetic
// energy. The contact splits their pairs into shapes symmetric and antisymmetric to the plane
// through the contact and the spin axis.
#pragma once

#include <vector>

#include "base/result.h"
#include "models/ring_tire/ring/ring_tire.h"

namespace latsch::ring_tire {

struct StandingMode {
  int n = 0;               // waves around the circumference
  bool lateral = false;    // out of the plane of the rim, with torsion
  char phase = ' ';        // 's', 'a'; ' ': neither, or there is no lowest node
  int order = 1;           // among modes of the same n, plane and phase, by frequency
  double share = 0.0;      // share of the mode's kinetic energy in these waves
  double frequency = 0.0;  // Hz, undamped
  double damping = 0.0;    // D, share of critical damping
  NodeValues shape;        // u_r, u_t, u_y (m) and ψ (rad) of every node; mass 1
};

/// Returns the `count` lowest modes of a settled tire, or a Failure if it does not stand stably.
Result<std::vector<StandingMode>> standing_modes(const RingTire& tire, int count);

}  // namespace latsch::ring_tire
