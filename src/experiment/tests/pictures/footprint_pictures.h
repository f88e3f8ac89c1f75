// SPDX-License-Identifier: Apache-2.0
// Draws footprints on a page: the pressure seen from above, and the elements that represent it.
#pragma once

#include <string>
#include <vector>

#include "experiment/language/test.h"
#include "experiment/rigs/footprint_rig.h"

namespace latsch::experiment {

/// A quantity of a footprint's elements on a map seen from above, forward to the right.
struct FootprintMap {
  std::string title, unit;  // title of the picture, unit of the scale
  double factor = 1.0;      // numbers of the scale in SI: 1e5 for bar
  int digits = 2;           // after the point, in the tips
  double most = 1.0;        // SI, top of the scale; the scale begins at 0
};
/// Draws the values, SI, one for each element of the footprint.
std::string footprint_map(const Footprint& print,
                          const std::vector<double>& values,
                          const FootprintMap& map);

/// Returns one picture for each state, with one scale of pressure for all. Numbers: "state" (from
/// 1), "x", "y", "pressure", "shear_x", "shear_y" of every element, SI.
Test::Details footprint_details(const std::vector<StandingFootprint>& states);

}  // namespace latsch::experiment
