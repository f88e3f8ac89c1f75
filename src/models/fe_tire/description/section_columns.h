// SPDX-License-Identifier: Apache-2.0
// Columns of elements of a section, described by the positions at which they end.
#pragma once

#include <vector>

#include "models/fe_tire/description/tire_description.h"

namespace latsch::fe_tire {

/// Returns the positions, from 0 (crown) to 1 (bead), at which the columns of a section end, as in
/// Section::columns. If the number of columns is odd, one column lies across the crown and ends at
/// the first position after 0.
std::vector<double> columns_of(const Section& section);

/// Returns the description of the tire with columns that end at these positions.
TireDescription with_columns(TireDescription tire, std::vector<double> columns);

}  // namespace latsch::fe_tire
