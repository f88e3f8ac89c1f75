// SPDX-License-Identifier: Apache-2.0
// Chains of points around a rolling finite-element tire (rolling/rolling_chain.h), as channels.
#pragma once

#include <string>
#include <vector>

#include "experiment/rigs/fe_tire/rolling_rig.h"

namespace latsch::experiment {

/// Places of the chains in the section (fe_tire::find_place).
struct ChainPlaces {
  std::vector<double> positions = {0.0};
  std::string depth = "outer";
};

/// Returns the channels without values: their names and units.
Channels no_chains();

/// Returns the chains of every state, one after the other, and of every position in a state; the
/// points of a chain follow each other in ascending theta, from -pi to pi. Channels: "state" (from
/// 1), "position", "theta" (rad, 0 at the contact, positive toward the leading edge), "x", "y",
/// "z", "u_x" ... "u_z" (m), "v_x" ... (m/s), "a_x" ... (m/s^2) in axes of the wheel; "E_rr",
/// "E_tt", "E_yy", "G_rt", "G_ty", "G_ry" (strains, engineering shear), "S_rr" ... "S_ry" (Pa) in
/// radial, circumferential and axial axes of the point; "cord_strain", "cord_stress" (Pa),
/// "cord_force" (N/m), "energy" (J/m^3), "dissipation" (W/m^3). A Failure names the place that does
/// not exist or the state that was not found.
Result<Channels> chains(TireRig& rig, const RollingTest& test, const ChainPlaces& places);
/// Returns the chains of states that are found.
Result<Channels> chains_of(TireRig& rig,
                           const std::vector<RolledState>& states,
                           const ChainPlaces& places);

}  // namespace latsch::experiment
