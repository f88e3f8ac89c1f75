// SPDX-License-Identifier: Apache-2.0
// Nuisance numbers of all recordings at the best point of a study: their values, how uncertain they
// are, how far they are from their priors, and what they cost: the intervals of the variables as
// they are, and as they would be if the numbers were known exactly.
//
// No trial is run: the trials that gave the derivatives of the residuals are compared once more,
// with the numbers held at their values. The deviation of a number covers its own scatter at given
// variables and its change with the variables, to first order.
#pragma once

#include <string>
#include <vector>

#include "correlation/analysis/identifiability.h"

namespace latsch::correlation {

/// One nuisance number of one recording.
struct NuisanceRow {
  int experiment = 0;  // index in the study
  NuisanceNumber number;
  double value = 0.0;      // SI
  double deviation = 0.0;  // standard deviation, SI; NaN: not known
  bool at_end = false, is_determined = true;
  double lower = -INFINITY, upper = INFINITY;  // range in which a shift was solved, SI

  /// Returns for example "gain: 2.9 % +- 0.4 %, prior 0 +- 1 %, 2.9 deviations from its prior".
  std::string in_words() const;
  /// True if the number is free and variables act like it, so that it may have any value.
  bool is_open() const;
  /// Returns how many deviations of its prior the value is from 0; 0 for a free number.
  double from_prior() const { return number.is_free() ? 0.0 : std::abs(value) / number.prior; }
};

/// Intervals of one variable in the unit cube.
struct NuisanceCost {
  int variable = 0;
  Interval with, without;  // with the numbers solved, and with them known
};

struct NuisanceTable {
  std::vector<NuisanceRow> rows;
  std::vector<NuisanceCost> costs;   // empty: not known
  std::vector<std::string> remarks;  // numbers that act like a variable

  bool empty() const { return rows.empty(); }
};

/// Returns the table; empty if no recording has nuisance numbers, or if the trials at and beside
/// the point are not in the journal.
NuisanceTable nuisance_table(const Study& study,
                             const Identifiability& what,
                             const Journal& journal);

/// Returns for example "stiffness: 95 %: 74 .. 76 N/mm with the nuisance numbers solved, 74.8 ..
/// 75.2 N/mm if they were known".
std::string cost_text(const Study& study, const NuisanceCost& cost);

}  // namespace latsch::correlation
