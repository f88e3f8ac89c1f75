// SPDX-License-Identifier: Apache-2.0
// What a page shows of a K&C rig: the loops that travel and angles make over what is prescribed, in
// the order of the states, with the lines whose slopes are the numbers of the rig.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/language/test.h"
#include "experiment/rigs/rig_slopes.h"

namespace latsch::experiment {

/// Channels "dx", "dx_L" ... with these endings, over that of the slopes or, without, over that of
/// `prescribed` that varies first. Nothing where none does.
std::vector<Test::Picture> loop_pictures(const Channels& recorded,
                                         const std::vector<std::string>& prescribed,
                                         const std::vector<std::string>& endings,
                                         const std::optional<SlopesBy>& slopes);

}  // namespace latsch::experiment
