// SPDX-License-Identifier: Apache-2.0
// The numbers of a tire's file moved a little, one at a time: what its slopes are taken of
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

/// What makes the tire of a file of sections and plies, its tread split; a mesh is built once for
/// all that have it.
std::function<fe_tire::VariedTire(const Document&)> described_tires(
    const fe_tire::TreadSplit& split = {});

/// Of the numbers at these paths, each by a small share of itself; `tire` makes the tire of a file.
/// A Failure names the path by which the mesh becomes another one.
Result<std::vector<fe_tire::Variation>> fe_variations(
    const Document& numbers,
    const std::vector<std::string>& paths,
    const std::function<fe_tire::VariedTire(const Document&)>& tire);

}  // namespace latsch::experiment
