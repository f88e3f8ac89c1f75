// SPDX-License-Identifier: Apache-2.0
// Reads the states of a rolling finite-element tire from a table of states
// (rigs/slip/slip_states.h), within what such a tire can do.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "experiment/rigs/fe_tire/rolling_rig.h"
#include "formats/tables/csv_table.h"

namespace latsch::experiment {

/// Ranges of the states.
constexpr std::size_t kMostRollingRows = 2000;  // each takes seconds to compute
constexpr double kMostRollingSlipAngle = 1.4;  // rad; beyond it the tire slides sideways as a whole
constexpr double kLeastRollingSlip = -1.0, kMostRollingSlip = 5.0;  // -1: locked
constexpr double kMostRollingCamber = 0.5;                          // rad

/// Says what a test takes from the columns of a table.
struct TableReading {
  std::optional<double> speed = {};  // m/s, in place of the column Vx; needed if there is none
  bool takes_pressure = true;        // false: the column p is not used
  bool takes_turn_slip = true;       // false: the column phit is not used
  /// True if the wheel rolls freely where the table has no column kappa; false: with kappa = 0.
  bool is_free_without_kappa = true;
  /// True if the states are samples of a record in time, whose number has another limit.
  bool is_record = false;
};

/// Returns the states of a table. Throws InputError, which names the line of the table, for a state
/// beyond these ranges, and for a table without states or with too many.
std::vector<RollingRow> rows_of(const formats::CsvTable& table, const TableReading& reading);

}  // namespace latsch::experiment
