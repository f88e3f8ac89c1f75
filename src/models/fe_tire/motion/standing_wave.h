// SPDX-License-Identifier: Apache-2.0
// Waves that stand still beside a spinning tire. A wave of n waves around is no longer held if its
// frequency seen from the axle is zero: K(n) - Omega^2 W(n) is singular. [Graham, discussion of
// Krylov & Gilbert, J. Sound Vib. 329 (2010) 4398-4408]
#pragma once

#include <optional>

#include "models/fe_tire/motion/spin.h"

namespace latsch::fe_tire {

/// Inertia of a sector in both axes. The two W(n) differ by an error of second order in the width
/// of a sector; a wave counts as held if neither takes its stiffness away, so that states with
/// inertia (W.1) and modes with (W.2) exist below one speed.
struct BothInertias {
  SectorFlow flow;
  SectorSpin spin;

  explicit BothInertias(const RingElements& elements) : flow(elements), spin(elements) {}
};

/// True if K(n) - speed^2 W(n) is positive definite for every n.
bool holds_every_wave(const SectorBlocks& K,
                      const BothInertias& inertia,
                      const Ring& ring,
                      double speed);

/// The lowest speed at which K(n) - speed^2 W(n) of a tangent that does not change is singular.
struct CriticalWave {
  double speed = 0.0;  // rad/s
  int n = 0;
};
/// Returns nothing if K(n) is not positive definite or if no speed below `highest` is critical.
std::optional<CriticalWave> critical_wave(const SectorBlocks& K,
                                          const BothInertias& inertia,
                                          const Ring& ring,
                                          double highest);

}  // namespace latsch::fe_tire
