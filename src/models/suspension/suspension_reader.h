// SPDX-License-Identifier: Apache-2.0
// Reads a corner of a suspension from its file:
//
//   kind = "suspension"
//   title = "Front left"
//   side = "left"                        # of the car: its hardpoints have y > 0; or "right"
//   pushrod_on = "upper_wishbone"        # or "lower_wishbone", "upright"
//   [hardpoint]                          # x forward, y left, z up
//   uca_front = ["1648.347 mm", "273.206 mm", "303.434 mm"]
//   # and uca_rear, lca_front, lca_rear, ubj, lbj, pushrod_inner, pushrod_outer, trackrod_inner,
//   # trackrod_outer, wheel_center, contact
//   [bushing.all]                        # for joints without values of their own
//   x = "30 kN/mm"                       # y, z likewise
//   about_x = "200 N m/rad"              # about_y, about_z
//   [bushing.ubj]
//   y = "12 kN/mm"
//
// In place of [hardpoint] the file may have, before all tables, hardpoints = "hardpoints.csv" and,
// if that contains several corners, hardpoints_of = "FL" (formats/car/hardpoint_table.h); the code
// that reads the file inserts these points. Bushings are for statics; the kinematics have points of
// their own (geometry_reader.h). A five-link corner has [bushing.NAME_inner] and
// [bushing.NAME_outer] for each link, and pushrod_inner and pushrod_outer (compliant_corner.h).
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/document.h"
#include "models/suspension/compliant_corner.h"

namespace latsch::suspension {

/// A suspension corner as described in its file.
struct SuspensionCorner {
  CornerGeometry geometry;                   // hardpoints and links
  std::optional<CompliantCorner> compliant;  // bodies and bushings; not set without [bushing]
  std::optional<DoubleWishbone> statics;     // its double wishbone; not set for five links
};

/// Reads a suspension corner. Throws InputError naming file and line, or the part that is not
/// valid.
SuspensionCorner read_corner(const Node& root);
/// Reads the double wishbone with its bushings. Throws InputError also if the corner is no double
/// wishbone or has no bushings.
DoubleWishbone read_suspension(const Node& root);

/// Returns the stiffnesses that the number at a path of the file sets, as pairs of joint index and
/// axis index (x, y, z, about_x ...). A number of [bushing.all] sets several; a number that is no
/// stiffness sets none.
std::vector<std::pair<int, int>> stiffnesses_at(const Document& numbers,
                                                const std::string& path,
                                                const std::vector<multibody::Joint>& joints);
/// Returns true if a number at this path is one of the stiffnesses that stiffnesses_at() finds.
/// Stiffnesses of curves, play and friction are not among them.
bool is_stiffness(const std::string& path);

}  // namespace latsch::suspension
