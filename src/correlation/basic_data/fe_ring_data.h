// SPDX-License-Identifier: Apache-2.0
// A flexible ring derived from the FE tire: what the FE tire shows on the virtual rig becomes the
// data that ring_data.h solves for the ring's numbers.
//
//   loads        at three deflections on flat ground: stiffness of the sidewall, its growth, and
//                what of the pressure the belt carries
//   frequencies  of the unloaded tire by circumferential harmonics, f1 torsional n = 0, f2 radial
//                n = 1, f3 lateral n = 0, f4 lateral n = 1, f5 and f6 radial and lateral n = 2
// Loads have no mass in them and frequencies do: together they determine the equivalent mass of the
// belt as well, so the ring's mass is what moves in the FE tire's modes, with its share of the
// sidewalls. The FE tire has no damping and no tread blocks; those stay as the known ring has them.
#pragma once

#include "correlation/basic_data/ring_data.h"
#include "models/fe_tire/ring/fe_tire.h"

namespace latsch::correlation {

/// `known`: a file of kind "ring_tire"; its numbers are the first guesses. Its pressure has to be
/// that of the test, Pa. A Failure is the FE tire's.
Result<RingData> ring_data_of(fe_tire::FeTire& tire, double pressure, const Document& known);

}  // namespace latsch::correlation
