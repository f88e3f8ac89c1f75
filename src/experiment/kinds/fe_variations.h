// SPDX-License-Identifier: Apache-2.0
// Varies the numbers of a tire's file slightly, one at a time, for its slopes
// (models/fe_tire/slopes/tire_slopes.h).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/document.h"
#include "base/result.h"
#include "models/fe_tire/description/fine_tread.h"
#include "models/fe_tire/slopes/tire_slopes.h"

namespace latsch::experiment {

/// Returns a function that makes the tire of a file of sections and plies, its tread split; a mesh
/// is built once for all tires that share it.
std::function<fe_tire::VariedTire(const Document&)> described_tires(
    const fe_tire::TreadSplit& split = {});

/// Returns a variation for each number at these paths by a small share of itself; `tire` makes the
/// tire of a file. A Failure names a path that changes the mesh.
Result<std::vector<fe_tire::Variation>> fe_variations(
    const Document& numbers,
    const std::vector<std::string>& paths,
    const std::function<fe_tire::VariedTire(const Document&)>& tire);

}  // namespace latsch::experiment
