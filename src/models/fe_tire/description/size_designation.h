// SPDX-License-Identifier: Apache-2.0
// The size molded into a tire's sidewall and what it says about the section.
//
//   225/50R16      metric: nominal width 225 mm, height 50 % of it, radial, rim of 16 inches
//   16x7.5-10      racing: outer diameter, nominal width, rim, all in inches; - bias, R radial
//
// A prefix (P, LT) and service marks behind ("94W", "XL") are allowed and ignored.
#pragma once

#include <optional>
#include <string>

#include "models/fe_tire/description/contour.h"

namespace latsch::fe_tire {

struct SizeDesignation {
  double width = 0.0;           // m, nominal: of the section (metric) or of the tread (racing)
  double outer_diameter = 0.0;  // m, nominal, inflated and unloaded
  double rim_diameter = 0.0;    // m, nominal
  bool metric = true;
  bool radial = true;
};

/// Nothing where the text is no size designation.
std::optional<SizeDesignation> parse_size(const std::string& text);

/// What is wrong with a section of this outer radius, overall width (m) and bead point for a tire
/// of this size; empty where they agree. Tolerances: metric sizes follow the tire and rim
/// standard's order of magnitude (diameter 2 %, width 6 %); a racing section is up to a third wider
/// than its tread.
std::string size_conflict(const SizeDesignation& size,
                          double outer_radius,
                          double width,
                          MeridianPoint bead);

}  // namespace latsch::fe_tire
