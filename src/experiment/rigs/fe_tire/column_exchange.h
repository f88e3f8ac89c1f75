// SPDX-License-Identifier: Apache-2.0
// Columns and sectors exchanged by what is measured, on the ground too.
//
// Unloaded modes do not show what a mesh misses where it stands: the worst loaded mode is often
// none of theirs, and columns under the tread matter as soon as the ground bends it (race tire:
// lateral n=1, 1.2 % off where the unloaded tire was right within 1). The limits of all quantities
// are those of the body, whatever its mesh: found once (discretization.h), they judge any other
// mesh by its own values alone. So a mesh costs one trial in place of those of its refined ones.
//   Each column is halved in turn, and what that changes tells what other exchanges would: a column
// of length h errs by c h^3. Of all exchanges of up to three columns and sectors that keep the
// number of unknowns those that promise most are tried; the best is kept and begins the next round.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/result.h"
#include "experiment/rigs/fe_tire/column_placement.h"
#include "models/fe_tire/description/tire_description.h"

namespace latsch::placement {

/// `settings.deflection` > 0. Ends after `settings.rounds`, or where no exchange helps.
Result<ColumnPlacement> exchange_columns(const fe_tire::TireDescription& tire,
                                         const ColumnPlacementSettings& settings,
                                         const std::vector<double>& fixed,
                                         const std::function<void(const std::string&)>& progress);

}  // namespace latsch::placement
