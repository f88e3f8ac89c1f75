// SPDX-License-Identifier: Apache-2.0
// Colors for plots that color-blind readers can tell apart and that stay distinct in
// black-and-white print.
#pragma once

#include <string>

namespace latsch::report {

/// Returns a color from dark violet to yellow whose lightness rises evenly with t, as "#440154";
/// for plots of a field. t is clamped to [0, 1]. [Smith & van der Walt, A better default colormap
/// for matplotlib, SciPy 2015: viridis]
std::string viridis(double t);

/// Returns the color of category number `index`; the hues are distinct. [Okabe & Ito, Color
/// universal design, 2008]
std::string category(int index);
/// Returns the color of the category in a muted tone, for areas below lines.
std::string muted_category(int index);

}  // namespace latsch::report
