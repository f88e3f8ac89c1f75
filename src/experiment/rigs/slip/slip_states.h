// SPDX-License-Identifier: Apache-2.0
// Reads states of a rolling tire from a table, and returns the forces of a steady-state tire as
// channels.
//
//   Fz [N], kappa [1], alpha [deg], gamma [deg], phit [1/m], Vx [km/h], p [bar]
//
// Columns may be in any order, under any spelling (measurement/meaning/channel_words.h: SA, Radlast
// ...), in any unit of their dimension. A column with one of the names above is in SI if it has no
// unit; another spelling must have a unit. Fz is required; missing slips and camber are 0, a
// missing speed is that of the measurement (LONGVL), a missing pressure that of the file
// (INFLPRES). Columns with other names are not used; a column that looks like a missing state is an
// error.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiment/rigs/measured_conditions.h"
#include "formats/tables/csv_table.h"
#include "measurement/channels.h"
#include "measurement/ledger.h"
#include "models/magic_formula/magic_formula.h"

namespace latsch {

/// Returns the columns as conditions from a measurement: Fz, in W, is required. `no_turn_slip` says
/// why the test ignores phit; empty if the test uses it.
std::vector<experiment::MeasuredCondition> measured_states(const std::string& no_turn_slip = "");

/// Returns how each column of such a table is interpreted, what is assumed, and what is doubtful.
Ledger ledger_of_states(const formats::CsvTable& table,
                        const std::string& by,
                        const std::string& no_turn_slip = "");

struct SlipStates {
  std::vector<magic_formula::State> states;
  std::vector<std::string> unused;  // columns that are not used
};

/// Reads a table of any length, a block of states at a time. Throws InputError naming file and
/// line. Returns the columns that are not used.
std::vector<std::string> for_slip_states(
    const formats::CsvTable& table,
    const magic_formula::Parameters& tire,
    int rows,
    const std::function<void(std::vector<magic_formula::State>&)>& block);

/// Reads all states. Throws InputError naming file and line.
SlipStates slip_states(const formats::CsvTable& table, const magic_formula::Parameters& tire);

/// Returns a sentence that names the states that a table lacks and the values assumed for them, and
/// the columns without a unit and the units assumed for them; empty if nothing is assumed. Turn
/// slip (phit) is not named, because a table without it is one of straight rolling.
std::string assumed_states(const formats::CsvTable& table, const magic_formula::Parameters& tire);

/// Returns the channels Fx Fy Fz Mx My Mz R_e R_l rho length width t Mzr mux muy omega Kxk Kya Cx
/// Cy Cz sigma_x sigma_y, one value for each state.
Channels answers(const std::vector<magic_formula::SteadyState>& results);
Channels answers(const magic_formula::MagicFormula& tire,
                 const std::vector<magic_formula::State>& states);

/// Returns a column of a table of states in SI; empty if the table lacks it or is longer than
/// 200,000 rows.
std::vector<double> values_of(const formats::CsvTable& table, const std::string& condition);

/// Returns the channels with the slopes of some of them in parameters of the tire:
/// magic_formula_slopes.h.
Channels with_slopes(const Channels& answers,
                     const magic_formula::MagicFormula& tire,
                     const std::vector<magic_formula::State>& states,
                     const std::vector<std::string>& channels,
                     const std::vector<std::string>& parameters);

/// Returns the number of states outside the ranges of the file, at which limits clamp them.
int outside_of_ranges(const std::vector<magic_formula::State>& states,
                      const magic_formula::Parameters& tire);

}  // namespace latsch
