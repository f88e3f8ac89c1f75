// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_rolling/rolling_table.h"

#include <fmt/format.h>

#include <cmath>

#include "base/error.h"
#include "experiment/rigs/slip/slip_states.h"

namespace latsch::experiment {
namespace {

/// Throws InputError for a row that no finite-element tire can roll through.
void check(const RollingRow& row, const Place& place) {
  const auto reject = [&](const char* what, double value, const char* expected) {
    throw InputError(place, fmt::format("{} is {:g}, expected {}", what, value, expected));
  };
  if (!(row.load > 0.0))
    reject("Fz (N)", row.load, "a load above 0: a finite-element tire in the air has no state");
  if (!(row.speed > 0.0))
    reject("Vx (m/s)",
           row.speed,
           "a speed above 0, because a finite-element tire has steady states of forward rolling "
           "alone");
  if (!(std::abs(row.alpha) <= kMostRollingSlipAngle))
    reject("alpha (rad)", row.alpha, "up to 1.4");
  if (row.kappa && !(*row.kappa >= kLeastRollingSlip && *row.kappa <= kMostRollingSlip))
    reject("kappa", *row.kappa, "-1 (locked) to 5");
  if (!(std::abs(row.camber) <= kMostRollingCamber)) reject("gamma (rad)", row.camber, "up to 0.5");
  if (row.pressure && !(*row.pressure > 0.0)) reject("p (Pa)", *row.pressure, "above 0");
}

}  // namespace

std::vector<RollingRow> rows_of(const formats::CsvTable& table, const TableReading& reading) {
  const auto count = static_cast<std::size_t>(table.rows());
  if (!reading.is_record && count > kMostRollingRows)
    throw InputError(table.header_place(),
                     fmt::format("the table has {} states, expected at most {}, because each takes "
                                 "a finite-element tire seconds",
                                 count,
                                 kMostRollingRows));
  const auto has = [&](const char* name) { return !values_of(table, name).empty(); };
  const bool has_kappa = has("kappa"), has_pressure = reading.takes_pressure && has("p");
  std::vector<RollingRow> rows;
  for (const magic_formula::State& state : slip_states(table, {}).states) {
    RollingRow row{state.Fz, reading.speed.value_or(state.Vx)};
    if (has_kappa || !reading.is_free_without_kappa) row.kappa = state.kappa;
    row.alpha = state.alpha;
    row.camber = state.gamma;
    if (reading.takes_turn_slip) row.turn_slip = state.phit;
    if (has_pressure) row.pressure = state.p;
    check(row, table.place(static_cast<int>(rows.size())));
    rows.push_back(row);
  }
  return rows;
}

}  // namespace latsch::experiment
