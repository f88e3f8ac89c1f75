// SPDX-License-Identifier: Apache-2.0
// Colors that stay distinct for color-blind readers and in gray print.
#pragma once

#include <string>

namespace latsch::report {

/// Returns a color from dark violet to yellow with evenly rising lightness, for fields: "#440154".
/// t is clamped to [0, 1]. [Smith & van der Walt, A better default colormap for matplotlib, SciPy
/// 2015: viridis]
std::string viridis(double t);

/// Returns distinct hues for categories. [Okabe & Ito, Color universal design, 2008]
std::string category(int index);
/// Returns the category's hue, muted for areas under lines.
std::string muted_category(int index);

}  // namespace latsch::report
