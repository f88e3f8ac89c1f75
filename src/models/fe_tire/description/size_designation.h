// SPDX-License-Identifier: Apache-2.0
// The size designation on a tire's sidewall and the dimensions of the section that it denotes.
//
//   225/50R16      metric: nominal width 225 mm, height 50 % of it, radial, rim of 16 inches
//   195/65R390     metric, rim in mm if 100 or more
//   185R14C        metric without a ratio: height 82 % of the width
//   59/80R63       inches: width 59, height 80 % of it; of two digits on a rim of 25 and more
//   10.00R20       inches: width and rim; 11R22.5, 18.4-38, 40.00R57
//   16x7.5-10      outer diameter, width, rim, all in inches; 138x41-84, 31x10.50R15LT
//   1400x530R23    outer diameter and width in mm, rim in inches (aircraft)
//
// R means radial, also with the letter of a speed before it (ZR, VR, HR, SR); - and D and B mean
// bias. Small letters, a multiplication sign in place of x, prefixes (P, LT, ST, T, C, IF, VF, H,
// B), marks directly behind the rim (LT, C, M/C) and service marks after a blank ("94W", "XL") are
// allowed and ignored.
#pragma once

#include <optional>
#include <string>

#include "models/fe_tire/description/contour.h"

namespace latsch::fe_tire {

struct SizeDesignation {
  double width = 0.0;           // m, nominal width of the section (metric) or of the tread (racing)
  double outer_diameter = 0.0;  // m, nominal diameter of the inflated, unloaded tire
  double rim_diameter = 0.0;    // m, nominal
  bool metric = true;           // false: all numbers of the designation are in inches
  bool radial = true;
  /// Relative deviations from the nominal dimensions that are allowed for a real tire. They are
  /// wide if the designation states no height.
  double diameter_tolerance = 0.02;
  double least_width = 0.94, most_width = 1.06;
};

/// Parses a size designation. Returns nothing if the text is none.
std::optional<SizeDesignation> parse_size(const std::string& text);

/// Compares a section's outer radius, overall width (m) and bead point with a tire size. Returns a
/// message that describes the conflict, or an empty text if they agree. Tolerances: metric sizes
/// follow the order of magnitude of the tire and rim standard (diameter 2 %, width 6 %). A racing
/// section is up to a third wider than its tread. Sizes without a height name the diameter within 8
/// % (10.00R20: 1054 mm, 11R22.5: 1054 mm, 18.4-38: 1750 mm, 40.00R57: 3594 mm).
std::string size_conflict(const SizeDesignation& size,
                          double outer_radius,
                          double width,
                          MeridianPoint bead);

}  // namespace latsch::fe_tire
