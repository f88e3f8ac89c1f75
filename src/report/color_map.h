// SPDX-License-Identifier: Apache-2.0
// Colors that stay distinct for color-blind readers and in gray print.
#pragma once

#include <string>

namespace latsch::report {

/// Dark violet to yellow, evenly lighter: for fields. t is clamped to [0, 1]. "#440154".
/// [Smith & van der Walt, A better default colormap for matplotlib, SciPy 2015: viridis]
std::string viridis(double t);

/// Distinct hues for kinds of things. [Okabe & Ito, Color universal design, 2008]
std::string category(int index);
/// The same, muted for areas under lines.
std::string muted_category(int index);

}  // namespace latsch::report
