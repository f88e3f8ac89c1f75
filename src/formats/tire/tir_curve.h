// SPDX-License-Identifier: Apache-2.0
// Reads [DEFLECTION_LOAD_CURVE] of a .tir: rows {pen fz}, deflection and vertical force.
// models/magic_formula/vertical/load_curve.h describes its meaning.
#pragma once

#include <functional>
#include <string>

#include "formats/text/teim_orbit.h"
#include "formats/tire/tir_file.h"

namespace latsch::formats {

/// Reads the curve into the parameters, all of which must have been read before, and adds a row to
/// the keys. A curve that begins after {0, 0} is continued to that point. Throws InputError, with
/// the line, for a row of other than two numbers, columns in another order, a curve that does not
/// rise or begins with a force, deflections that no tire has, and a curve a hundred times softer or
/// stiffer than VERTICAL_STIFFNESS. `doubt` receives warnings for the user, with their lines.
void read_load_curve(TirFile& tir,
                     const TeimOrbitUnits& units,
                     const std::function<void(int line, const std::string&)>& doubt);

}  // namespace latsch::formats
