// SPDX-License-Identifier: Apache-2.0
// Checks forces, radii and the contact patch of a .tir at its nominal load. Values that no tire has
// are reported with the coefficients that cause them.
#pragma once

#include "formats/tire/tir_sizes.h"
#include "models/magic_formula/parameters.h"

namespace latsch::formats {

/// Calls `note` for a side force or a longitudinal force of the wrong sign, friction that no tire
/// has, an effective rolling radius outside of the range from loaded to free radius, and a contact
/// patch larger than the tire.
void examine_forces(const magic_formula::Parameters& parameters, const AboutParameter& note);

}  // namespace latsch::formats
