// SPDX-License-Identifier: Apache-2.0
// Checks the axes of the K&C tables of a study: a table whose signs are those of the other side of
// the car, and a table whose axes are not stated and cannot be told from its signs.
//
// A table that contradicts iso axes is doubted where it is read (laboratory/record_ledger.h). Here
// every other convention is tried on the table: if the signs agree in it as well as in iso and it
// would change a channel that the study uses, then the data do not tell the axes, and the user has
// to state them. Whether they tell depends on the channels and the rows of the table: four rows with
// eight loads have no slopes, and displacements without loads have no law.
#pragma once

#include <vector>

#include "correlation/study/study.h"
#include "experiment/language/usual_numbers.h"

namespace latsch::correlation {

/// Returns a warning for every such table, at its line in the study.
std::vector<experiment::Finding> doubts_about_table_axes(const Study& study, const Document& file);

}  // namespace latsch::correlation
