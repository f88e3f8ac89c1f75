// SPDX-License-Identifier: Apache-2.0
// Responses of a rolling finite-element tire to slips that change harmonically, as channels
// (rolling/rolling_response.h). Inertia of the change is left out.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/rigs/fe_tire/rolling_rig.h"
#include "models/fe_tire/rolling/rolling_response.h"

namespace latsch::experiment {

/// A slip that may change, by the name of its channel.
struct ResponseSlip {
  const char* name;                      // "alpha"
  const char* of_slip;                   // in words: "slip angle"
  const char *force_unit, *moment_unit;  // SI, of a force and of a moment by the slip
  fe_tire::SlipInput input;
  /// Channel of the relaxation length, null if none is computed, and the force from which it is
  /// computed: 0 to 2, Fx to Fz.
  const char* relaxation = nullptr;
  int force = 0;
  /// The main force, 0 to 5, Fx to Mz, and the swing to both sides over which its slope is compared
  /// with that of steady states (response_swings.h), with the unit in which it is told.
  int judged = 0;
  double swing = 0.0;
  const char* swing_unit = "1";
};
/// "alpha", "kappa", "gamma", "phit".
const std::vector<ResponseSlip>& response_slips();

struct RollingResponseTest {
  RollingTest states;
  std::vector<ResponseSlip> slips;  // those that change
  std::vector<double> frequencies;  // Hz, ascending
  fe_tire::Axle axle = fe_tire::Axle::follows;
};

/// Returns the channels of the test, all frequencies of one state and then those of the next:
/// "state" (from 1), "frequency" (Hz), "path_frequency" (rad/m, 2 pi f over the speed along the
/// heading); for each slip and each force or moment "re_Fy_by_alpha", "im_Fy_by_alpha",
/// "tf_Fy_by_alpha" and "phase_Fy_by_alpha" (rad); "relaxation_side" (m, of Fy by alpha) and
/// "relaxation_slip" (m, of Fx by kappa). Without states: names and units.
Channels rolling_response_channels(
    const RollingResponseTest& test,
    const std::vector<std::vector<std::vector<fe_tire::SlipResponse>>>& responses,
    const std::vector<RolledState>& states);

/// Rolls the tire through the states and computes the responses about each. A Failure names the
/// state. Throws InputError if a frequency is higher than the sectors can show at a state's speed.
/// `remarks`: if not null, it receives sentences on slips that may swing only a little
/// (response_swings.h), which takes two steady states for each slip.
Result<Channels> rolling_response(TireRig& rig,
                                  const RollingResponseTest& test,
                                  std::vector<std::string>* remarks = nullptr);

}  // namespace latsch::experiment
