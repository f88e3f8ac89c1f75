// SPDX-License-Identifier: Apache-2.0
// A bushing from a file. [bushing.all] says what no joint of its own says otherwise.
//
//   [bushing.ubj]
//   x = "12 kN/mm"                       # y, z: the same
//   about_x = "200 N m/rad"              # about_y, about_z
//   rigid = true                         # in the place of all six: 10^10 N/m, turns freely; of a
//                                        # rod its spin alone is held (multibody/rod_spin.h)
//   damping = "0.1 ms"                   # damping over stiffness, of all six
//   viscous.x = "3 kN s/m"               # in the place of that along x; about_x in N m s/rad
//   curve.x = [["-1 mm", "-9 kN"], ["0 mm", "0 kN"], ["1 mm", "12 kN"]]   # in the place of x:
//                                        # force_curve.h; for about_x of angles and moments
//   play.y = [["0.1 mm", "30 kN/mm"]]    # gap to either side and stiffness beyond; beside y
//   friction.z = [["40 N", "20 kN/mm"]]  # limit and stiffness before it slips; beside z
//   maxwell.z = [["3 kN/mm", "8 ms"]]    # stiffness and time; beside z
//   file = "rubber.bus"                  # in the place of springs and dampers: of that file, which
//                                        # whoever reads the document puts in their place
#pragma once

#include <string>
#include <vector>

#include "base/document.h"
#include "models/multibody/bushing.h"

namespace latsch::suspension {

/// Of a joint by its name in the table of bushings. InputError.
multibody::BushingParameters read_bushing(const Node& bushings, const std::string& name);

/// The keys of springs, curves and dampers that make this bushing, which has no other parts, with
/// their values in SI: `x = "1.2e7 N/m"`. What read_bushing() makes of them is the same bushing.
std::vector<std::string> bushing_lines(const multibody::BushingParameters& bushing);

/// Keys that do not stand beside `file`.
const std::vector<std::string>& keys_in_place_of_a_file();

/// [["-1 mm", "-9 kN"], ...]
multibody::ForceCurve read_curve(const Node& table,
                                 const std::string& key,
                                 const std::string& unit,
                                 const std::string& unit_of_force);

}  // namespace latsch::suspension
