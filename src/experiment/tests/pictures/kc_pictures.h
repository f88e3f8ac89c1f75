// SPDX-License-Identifier: Apache-2.0
// Draws a K&C rig on a page: the loops of travel and angles over a prescribed quantity, in the
// order of the states, with the regression lines whose slopes are the numbers of the rig.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/language/test.h"
#include "experiment/rigs/rig_slopes.h"

namespace latsch::experiment {

/// Draws channels "dx", "dx_L" ... with these endings over the abscissa of the slopes or, without
/// slopes, over the first varying channel of `prescribed`. Returns nothing if none varies.
std::vector<Test::Picture> loop_pictures(const Channels& recorded,
                                         const std::vector<std::string>& prescribed,
                                         const std::vector<std::string>& endings,
                                         const std::optional<SlopesBy>& slopes);

}  // namespace latsch::experiment
