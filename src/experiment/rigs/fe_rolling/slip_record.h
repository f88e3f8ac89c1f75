// SPDX-License-Identifier: Apache-2.0
// A finite-element tire on a flat track through slips, loads and camber as they were recorded
// (passage/rolling_transient.h, or reduced_passage.h for a tire that its file reduces).
//
// The rig holds the wheel, and the ground moves below it: it comes along with Vx, sideways with Vx
// tan alpha at the contact center, leans by the camber about the line through the contact center,
// and rises until it carries the load. So the slip angle changes without turn slip, and the wheel
// has no accelerations but those of its spin, Omega = (1 + kappa) Vx/R_e with R_e of the free wheel
// at the load, speed and camber of the moment (free_radii.h). The pressure is the record's mean.
//
// The record begins with the steady state of its first sample and so does every stretch behind a
// gap (slip_lag.h). Between samples all quantities change evenly. Steps have one length, a part of
// the usual distance of samples; forces between two of them are recorded at samples in between.
//
// Steps do not follow vibrations of the belt but damp them, by 0.3 a step. Forces are those of the
// ground, in W.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiment/rigs/fe_tire/tire_rig.h"
#include "experiment/rigs/slip/steady_conditions.h"
#include "formats/tables/csv_table.h"
#include "measurement/channels.h"

namespace latsch::experiment {

/// Way, m, that the tire rolls in a step at most, unless the test states a step.
constexpr double kWayOfStep = 0.02;
/// Most steps of a record: a full tire of 22,000 unknowns takes over an hour for them.
constexpr long kMostRecordSteps = 20000;

/// Rolls the tire through a record with times, a table of slip_states.h, and passes the channels
/// "Fx" .. "Mz", "R_e", "R_l", "length", "width" and "omega" to `tell`, some samples at a time.
/// Adds how far a reduced tire is from the full one to `remarks`. Throws InputError, which names
/// the line, for a sample that the tire does not take; a Failure names the time of the step that
/// was not found.
Status roll_record(TireRig& rig,
                   const formats::CsvTable& table,
                   const SlipHistoryConditions& conditions,
                   const std::function<void(const Channels&)>& tell,
                   std::vector<std::string>& remarks);
/// Returns the channels of all samples.
Result<Channels> roll_record(TireRig& rig,
                             const formats::CsvTable& table,
                             const SlipHistoryConditions& conditions,
                             std::vector<std::string>& remarks);

/// Returns a sentence for everything that the tire assumes, does not use or leaves out, and for the
/// work that the record takes. Throws InputError as roll_record() does.
std::vector<std::string> remarks_on_record(const TireRig& rig,
                                           const formats::CsvTable& table,
                                           const SlipHistoryConditions& conditions);

}  // namespace latsch::experiment
