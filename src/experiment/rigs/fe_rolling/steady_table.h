// SPDX-License-Identifier: Apache-2.0
// A table of steady states of the finite-element tire, as the test "steady_states" asks for them of
// every tire (rigs/slip/slip_states.h): the same columns, channels, axes (W, ISO) and signs as
// those of a Magic Formula.
//
// kappa counts from the wheel that rolls freely at the same load, speed, camber and pressure
// (rolling_rig.h), so a table without a column kappa has kappa = 0, which is not a free wheel once
// the wheel has a slip angle. A missing speed is 60 km/h, a missing pressure that of the tire.
//
// Channels are those of slip_states.h that follow from one equilibrium: "Fx" .. "Mz", "R_e" (of the
// free wheel, m), "R_l" (m), "length", "width" (of the patch, m) and "omega" (rad/s). Stiffnesses,
// relaxation lengths and the parts of Mz are quantities of a formula, and are not there.
//
// If the tire has no Prony terms, the rolling resistance in Fx and My is that of sliding alone.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiment/rigs/fe_tire/tire_rig.h"
#include "experiment/rigs/slip/steady_conditions.h"
#include "formats/tables/csv_table.h"
#include "measurement/channels.h"

namespace latsch::experiment {

/// Speed of a table without a column of it, m/s.
constexpr double kAssumedSpeed = 60.0 / 3.6;

/// Returns why a finite-element tire does not take these conditions; empty if it does.
std::string refused_conditions(const SteadyConditions& conditions);

/// Rolls the tire through a table of states and passes the channels to `tell` in the order of the
/// table, one or more states at a time, as soon as they are known. Throws InputError, which names
/// the line, for a state or a condition that the tire does not take; a Failure names the state that
/// was not found.
Status roll_table(TireRig& rig,
                  const formats::CsvTable& table,
                  const SteadyConditions& conditions,
                  const std::function<void(const Channels&)>& tell);

/// Returns the channels of all states of a table. With `slopes`, channels have those that are known
/// (slopes_of() in rolling_rig.h, and R_e).
Result<Channels> roll_table(TireRig& rig,
                            const formats::CsvTable& table,
                            const SteadyConditions& conditions,
                            fe_tire::TireSlopes* slopes = nullptr);

/// Returns a sentence for everything that the tire assumes, does not use or leaves out. Throws
/// InputError as roll_table() does.
std::vector<std::string> remarks_on_table(const TireRig& rig,
                                          const formats::CsvTable& table,
                                          const SteadyConditions& conditions);

}  // namespace latsch::experiment
