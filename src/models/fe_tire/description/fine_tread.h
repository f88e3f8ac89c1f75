// SPDX-License-Identifier: Apache-2.0
// A tire with short elements in the part of the tread that may touch the ground.
//
// Growth, forces and modes need short elements where the wall bends; a footprint needs several
// across and along the patch. If the patch spans only two or three elements in either direction,
// its length grows in steps of elements. A second mesh of the same tire, used for footprints only,
// costs less than such short elements in every computation.
#pragma once

#include <vector>

#include "models/fe_tire/description/tire_description.h"

namespace latsch::fe_tire {

/// Largest lengths of the tread's elements, m.
struct TreadElements {
  double around = 7e-3, across = 7e-3;
  bool operator==(const TreadElements&) const = default;
};

/// Number of equal parts into which each column (from the crown to the bead) and each sector (from
/// the contact upward, on both sides) is split. Columns and sectors behind the last entry stay as
/// they are.
struct TreadSplit {
  std::vector<int> columns, sectors;
  bool operator==(const TreadSplit&) const = default;
};

/// Splits the columns below the tread and the sectors that touch flat ground until none is longer
/// than `largest`; sectors in the patch of the first millimeters are split to half of `around`. If
/// any column is split, all are.
TreadSplit split_of(const TireDescription& tire, const TreadElements& largest);

/// Returns the tire with columns and sectors split.
TireDescription with_split_tread(TireDescription tire, const TreadSplit& split);

}  // namespace latsch::fe_tire
