// SPDX-License-Identifier: Apache-2.0
// A tire of which the tread has short elements where it may touch the ground.
//
// Growth, forces and modes ask for short elements where the wall bends, a footprint for some
// across and along the patch: where it has two or three of either, its length grows by elements.
// The same tire on a mesh of its own for footprints costs less than such elements in all that is
// done with it.
#pragma once

#include <vector>

#include "models/fe_tire/description/tire_description.h"

namespace latsch::fe_tire {

/// Largest lengths of a tread's elements, m.
struct TreadElements {
  double around = 7e-3, across = 7e-3;
  bool operator==(const TreadElements&) const = default;
};

/// Into how many equal parts columns (from the crown to the bead) and sectors (from the contact
/// upward, on both sides) are split; those behind the last stay as they are.
struct TreadSplit {
  std::vector<int> columns, sectors;
  bool operator==(const TreadSplit&) const = default;
};

/// Columns below the tread and sectors that touch on flat ground are split until none is longer,
/// in the first millimeters' patch half of that around. Where any column is split, all are.
TreadSplit split_of(const TireDescription& tire, const TreadElements& largest);

/// The same tire, split.
TireDescription with_split_tread(TireDescription tire, const TreadSplit& split);

}  // namespace latsch::fe_tire
