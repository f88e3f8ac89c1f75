// SPDX-License-Identifier: Apache-2.0
// Makes a tire file for any size from one of the shipped tires, the template.
//
// The contour is stretched to the size. Between bead and crown, radii change linearly to the new
// rim and the new outer diameter. At the widest point and above, widths scale with the section's
// width; at the bead they scale with the rim's width; between bead and widest point the scale
// changes linearly. The measuring rim of a metric size is a share of the section's width, rounded
// to half an inch, by the tire and rim standards [ETRTO, Standards Manual, "measuring rim"]: 0.70
// for sections 75 % high and more, 0.75 from 60, 0.80 from 50, 0.85 from 45, 0.90 below. The ends
// of belts, rubbers and thicknesses stay at the same points of the contour. Thicknesses, cords and
// moduli are those of the template: a first guess for a tire of its kind, not published data of a
// maker.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "base/document.h"
#include "experiment/language.h"

namespace latsch::cli {

/// Returns the tire file `text` stretched to the size designation. Throws InputError if the text is
/// no size designation or if the templates cannot be stretched to it.
std::string stretched_tire(std::string_view text, const std::string& size);

/// Computes new positions for explicitly listed columns of elements, and for the sectors
/// (column_placement.h). This takes seconds; `progress` is called in each round.
std::string with_placed_mesh(const std::string& stretched,
                             const std::string& size,
                             const std::function<void(const std::string&)>& progress = {});

/// Stretches the tire to the size and places its mesh.
std::string sized_tire(std::string_view text, const std::string& size);

/// Returns the name of the shipped tire from which a tire of the given size is made.
std::string template_of(const std::string& size);

/// Returns the largest number of unknowns that the mesh of a tire of this size may have.
int most_unknowns(const std::string& size);

/// Inflates the tire and says how large it is beside its size. A designation states the size of an
/// inflated tire, but the contour is drawn to it without pressure. It takes a second.
std::string inflated_size_in_words(const Document& tire,
                                   const std::string& size,
                                   const experiment::Language& language);

/// Returns the tire on a mesh of some hundred elements: a trial takes a fraction of a second, and
/// forces and frequencies have errors of some percent.
std::string coarse_tire(const std::string& text);

}  // namespace latsch::cli
