// SPDX-License-Identifier: Apache-2.0
// The modes of a flexible ring with its rim fixed, off the ground or standing on it.
//
// Channels, one value for each mode: "frequency" (Hz), "damping" (of critical), and "n", "type",
// "phase" in the codes of mode_record.h.
#pragma once

#include "base/result.h"
#include "experiment/rigs/load_case.h"
#include "measurement/channels.h"

namespace latsch::ring_tire {
class RingTire;
}

namespace latsch::experiment {

Result<Channels> run(ring_tire::RingTire& tire, const ModalTest& test);

}  // namespace latsch::experiment
