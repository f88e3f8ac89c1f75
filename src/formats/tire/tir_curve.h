// SPDX-License-Identifier: Apache-2.0
// [DEFLECTION_LOAD_CURVE] of a .tir: rows {pen fz}, deflection and vertical force. What it means is
// in models/magic_formula/vertical/load_curve.h.
#pragma once

#include <functional>
#include <string>

#include "formats/text/teim_orbit.h"
#include "formats/tire/tir_file.h"

namespace latsch::formats {

/// Reads the curve into the parameters, which have to be complete, and adds a row to the keys. A
/// curve that begins behind {0, 0} is continued to it. Throws InputError, with the line, for a row
/// of other than two numbers, columns in another order, a curve that does not rise or begins with a
/// force, deflections that no tire has, and a curve a hundred times softer or stiffer than
/// VERTICAL_STIFFNESS. `doubt` receives what the user has to know, with its line.
void read_load_curve(TirFile& tir,
                     const TeimOrbitUnits& units,
                     const std::function<void(int line, const std::string&)>& doubt);

}  // namespace latsch::formats
