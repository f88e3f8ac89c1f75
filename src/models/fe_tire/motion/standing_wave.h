// SPDX-License-Identifier: Apache-2.0
// Waves that stand still beside a spinning tire. A wave of n waves around is no longer held if its
// frequency seen from the axle is zero: K(n) - Omega^2 W(n) is singular. [Graham, discussion of
// Krylov & Gilbert, J. Sound Vib. 329 (2010) 4398-4408]
//
// W is that of (W.1): it errs for short waves as K does, by the same shape functions, so that their
// speeds are right on coarse meshes, too. That of (W.2), with n^2 M, would lose waves
// shorter than six sectors too early.
#pragma once

#include <optional>

#include "models/fe_tire/motion/spin.h"

namespace latsch::fe_tire {

/// Largest circumferential number that a ring's sectors carry: three sectors a wave. In shorter
/// ones elements hold their hourglass motions only weakly, and waves would be lost that no tire
/// loses.
int most_waves(const Ring& ring);

/// True if K(n) - speed^2 W(n) is positive definite for every n.
bool holds_every_wave(const SectorBlocks& K,
                      const SectorFlow& flow,
                      const Ring& ring,
                      double speed);

/// The lowest speed at which K(n) - speed^2 W(n) of a tangent that does not change is singular.
struct CriticalWave {
  double speed = 0.0;  // rad/s
  int n = 0;
};
/// Returns nothing if K(n) is not positive definite or if no speed below `highest` is critical.
std::optional<CriticalWave> critical_wave(const SectorBlocks& K,
                                          const SectorFlow& flow,
                                          const Ring& ring,
                                          double highest);

}  // namespace latsch::fe_tire
