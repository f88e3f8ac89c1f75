// SPDX-License-Identifier: Apache-2.0
// The columns of elements of a section as positions at which they end.
#pragma once

#include <vector>

#include "models/fe_tire/description/tire_description.h"

namespace latsch::fe_tire {

/// Section::columns of any section, from 0 (crown) to 1 (bead): where its columns end. An odd
/// number of them has one across the crown, which ends at the first position behind 0.
std::vector<double> columns_of(const Section& section);

/// The tire with columns that end there.
TireDescription with_columns(TireDescription tire, std::vector<double> columns);

}  // namespace latsch::fe_tire
