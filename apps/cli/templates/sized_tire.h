// SPDX-License-Identifier: Apache-2.0
// A tire file for any size, drawn from one of the tires that are shipped.
//
// The contour is stretched to the size. Between bead and crown radii go linearly to the new rim and
// the new outer diameter; the width goes with the section's width where it is widest and above, and
// with the rim's at the bead, linearly in between. The measuring rim of a metric size is that share
// of the section's width, rounded to half an inch, which the tire and rim standards use [ETRTO,
// Standards Manual, "measuring rim"]: 0.70 for sections 75 % high and more, 0.75 from 60, 0.80 from
// 50, 0.85 from 45, 0.90 below. All positions along the wall, of belts, rubbers and thicknesses,
// stay at the same point of the contour. Thicknesses, cords and moduli are those of the template: a
// first guess of a tire of its kind, nothing a maker has published.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace latsch::cli {

/// The tire file `text` stretched to the size designation. Throws InputError where it is no size,
/// or one that the templates cannot be stretched to.
std::string stretched_tire(std::string_view text, const std::string& size);

/// Columns of elements that are told one by one, and the sectors beside them, placed anew
/// (column_placement.h), in seconds; `progress` is told each round.
std::string with_placed_mesh(const std::string& stretched,
                             const std::string& size,
                             const std::function<void(const std::string&)>& progress = {});

/// Both.
std::string sized_tire(std::string_view text, const std::string& size);

/// The shipped tire from which a tire of that size is drawn: its name.
std::string template_of(const std::string& size);

/// Unknowns its mesh may have.
int most_unknowns(const std::string& size);

/// The same tire on a mesh of some hundred elements: a trial takes a fraction of a second, and
/// forces and frequencies are some percent off.
std::string coarse_tire(const std::string& text);

}  // namespace latsch::cli
