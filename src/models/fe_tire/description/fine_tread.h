// SPDX-License-Identifier: Apache-2.0
// Describes a tire with short elements in the part of the tread that may touch the ground.
//
// Growth, forces and modes need short elements where the wall bends, but a footprint needs several
// elements along and across the patch. If the patch is only two or three elements long or wide, its
// dimensions change in steps of elements. A second mesh of the same tire that is used for
// footprints only costs less than short elements in every computation.
#pragma once

#include <vector>

#include "models/fe_tire/description/tire_description.h"

namespace latsch::fe_tire {

/// Largest permitted lengths of the tread's elements, m, around the tire and across.
struct TreadElements {
  double around = 7e-3, across = 7e-3;
  bool operator==(const TreadElements&) const = default;
};

/// Number of equal parts into which each column (counted from the crown to the bead) and each
/// sector (from the contact upward, on both sides) is split. Columns and sectors beyond the last
/// entry are not split.
struct TreadSplit {
  std::vector<int> columns, sectors;
  bool operator==(const TreadSplit&) const = default;
};

/// Determines the splits. Columns below the tread, and sectors that touch flat ground, are split
/// until no element is longer than `largest`. Sectors in the patch of the first millimeters are
/// split to half of `largest.around`. If any column is split, all columns are.
TreadSplit split_of(const TireDescription& tire, const TreadElements& largest);

/// Returns the description of the tire with its columns and sectors split.
TireDescription with_split_tread(TireDescription tire, const TreadSplit& split);

}  // namespace latsch::fe_tire
