// SPDX-License-Identifier: Apache-2.0
// The modes of a tire with its rim held, off the ground or standing on it.
//
//   kind = "modes"
//   load = "4 kN"                    # or deflection = "20 mm"; neither: in the air
//   camber = "2 deg"                 # about x, top to the right; default 0
//   count = 12                       # lowest modes; default 10
//
// Channels, one value a mode: "frequency" (Hz), "damping" (of critical), and "n", "type", "phase"
// in the codes of mode_record.h.
#pragma once

#include <optional>

#include "base/document.h"
#include "base/result.h"
#include "measurement/channels.h"

namespace latsch::ring_tire {
class RingTire;
}

namespace latsch::experiment {

struct VibrationTest {
  std::optional<double> load = {};        // N; one of the two, or none
  std::optional<double> deflection = {};  // m
  double camber = 0.0;                    // rad
  int count = 10;
};

/// Throws InputError naming the place; unknown keys too.
VibrationTest read_vibration_test(const Node& root);

Result<Channels> run(ring_tire::RingTire& tire, const VibrationTest& test);

}  // namespace latsch::experiment
