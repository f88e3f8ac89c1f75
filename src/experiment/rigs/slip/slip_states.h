// SPDX-License-Identifier: Apache-2.0
// States of a rolling tire as a table has them, and what a steady-state tire answers as channels.
//
//   Fz [N], kappa [1], alpha [deg], gamma [deg], phit [1/m], Vx [km/h], p [bar]
//
// Columns in any order, by any spelling (measurement/meaning/channel_words.h: SA, Radlast ...), in
// any unit of their dimension. A column of one of these very names is in SI where it has no unit;
// another spelling has to have one. Fz has to be there; slips and camber that are missing are 0,
// the speed is that of the measurement (LONGVL), the pressure the file's own (INFLPRES). Columns of
// other names are not used; one that looks like a state that is missing is an error.
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

/// Its columns, to be taken from a measurement: Fz, in W, has to be there.
std::vector<experiment::MeasuredCondition> measured_states();

/// What each column of such a table is taken for, what is assumed, and what is in doubt.
Ledger ledger_of_states(const formats::CsvTable& table, const std::string& by);

struct SlipStates {
  std::vector<magic_formula::State> states;
  std::vector<std::string> unused;  // columns
};

/// Of a table of any length, so many states at once. Throws InputError naming file and line.
/// Gives back the columns that are not used.
std::vector<std::string> for_slip_states(
    const formats::CsvTable& table,
    const magic_formula::Parameters& tire,
    int rows,
    const std::function<void(std::vector<magic_formula::State>&)>& block);

/// All of them. Throws InputError naming file and line.
SlipStates slip_states(const formats::CsvTable& table, const magic_formula::Parameters& tire);

/// Fx Fy Fz Mx My Mz R_e R_l rho length width t Mzr mux muy omega Kxk Kya Cx Cy Cz sigma_x sigma_y,
/// a value a state.
Channels answers(const std::vector<magic_formula::SteadyState>& results);
Channels answers(const magic_formula::MagicFormula& tire,
                 const std::vector<magic_formula::State>& states);

/// A column of a table of states, SI; empty where it has none of that name or is longer than
/// 200,000 rows.
std::vector<double> values_of(const formats::CsvTable& table, const std::string& condition);

/// The answers with the slopes of some channels in parameters of the tire: magic_formula_slopes.h.
Channels with_slopes(const Channels& answers,
                     const magic_formula::MagicFormula& tire,
                     const std::vector<magic_formula::State>& states,
                     const std::vector<std::string>& channels,
                     const std::vector<std::string>& parameters);

/// How many states lie outside of the ranges of the file, where limits clamp them.
int outside_of_ranges(const std::vector<magic_formula::State>& states,
                      const magic_formula::Parameters& tire);

}  // namespace latsch
