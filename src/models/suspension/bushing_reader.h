// SPDX-License-Identifier: Apache-2.0
// Reads a bushing from a file. [bushing.all] holds values for joints without values of their own.
//
//   [bushing.ubj]
//   x = "12 kN/mm"                       # y, z likewise
//   about_x = "200 N m/rad"              # about_y, about_z
//   rigid = true                         # replaces all six: 10^10 N/m, turns freely; of a rod only
//                                        # the spin is held (multibody/rod_spin.h)
//   damping = "0.1 ms"                   # damping over stiffness, of all six
//   viscous.x = "3 kN s/m"               # replaces the damping along x; about_x in N m s/rad
//   curve.x = [["-1 mm", "-9 kN"], ["0 mm", "0 kN"], ["1 mm", "12 kN"]]   # replaces x:
//                                        # force_curve.h; for about_x angles and moments
//   play.y = [["0.1 mm", "30 kN/mm"]]    # gap to either side and stiffness beyond; added to y
//   friction.z = [["40 N", "20 kN/mm"]]  # limit and stiffness before it slips; added to z
//   maxwell.z = [["3 kN/mm", "8 ms"]]    # stiffness and time; added to z
//   file = "rubber.bus"                  # replaces springs and dampers by those of that file,
//                                        # which the code that reads the document inserts
#pragma once

#include <string>
#include <vector>

#include "base/document.h"
#include "models/multibody/bushing.h"

namespace latsch::suspension {

/// Reads the bushing of a joint by its name in the table of bushings. Throws InputError.
multibody::BushingParameters read_bushing(const Node& bushings, const std::string& name);

/// Returns the keys of springs, curves and dampers, in SI units, such as `x = "1.2e7 N/m"`, from
/// which read_bushing() makes this bushing. The bushing must have no other parts.
std::vector<std::string> bushing_lines(const multibody::BushingParameters& bushing);

/// Returns the keys that must not be given in a table that has the key `file`.
const std::vector<std::string>& keys_in_place_of_a_file();

/// Reads a curve such as [["-1 mm", "-9 kN"], ...]. Throws InputError also for a curve that drives
/// the motion instead of resisting it, together with the stiffness `beside` (force per `unit`) of
/// the same axis.
multibody::ForceCharacteristic read_curve(const Node& table,
                                          const std::string& key,
                                          const std::string& unit,
                                          const std::string& unit_of_force,
                                          double beside = 0.0);

}  // namespace latsch::suspension
