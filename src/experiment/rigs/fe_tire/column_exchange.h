// SPDX-License-Identifier: Apache-2.0
// Exchanges columns and sectors of a mesh according to computed errors, including those on the
// ground.
//
// Unloaded modes do not show the error of a mesh on the ground: the worst loaded mode often has no
// unloaded counterpart, and columns under the tread matter as soon as the ground bends the tread
// (race tire: lateral n=1 had an error of 1.2 % although the unloaded tire was within 1 %). The
// limits of all quantities do not depend on the mesh: once computed (discretization.h), they give
// the error of any other mesh from its values. So a mesh costs one trial instead of those of its
// refinements.
//
// Each column is halved in turn, and the change predicts that of other exchanges: a column of
// length h has the error c h^3. Of all exchanges of up to three columns and sectors that keep the
// number of unknowns, the most promising are tried; the best is kept and begins the next round.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/result.h"
#include "experiment/rigs/fe_tire/column_placement.h"
#include "models/fe_tire/description/tire_description.h"

namespace latsch::placement {

/// Requires `settings.deflection` > 0. Ends after `settings.rounds`, or if no exchange helps.
Result<ColumnPlacement> exchange_columns(const fe_tire::TireDescription& tire,
                                         const ColumnPlacementSettings& settings,
                                         const std::vector<double>& fixed,
                                         const std::function<void(const std::string&)>& progress);

}  // namespace latsch::placement
