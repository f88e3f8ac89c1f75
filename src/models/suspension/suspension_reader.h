// SPDX-License-Identifier: Apache-2.0
// A corner of a suspension from its file:
//
//   kind = "suspension"
//   title = "Front left"
//   side = "left"                        # of the car: its hardpoints have y > 0; or "right"
//   pushrod_on = "upper_wishbone"        # or "lower_wishbone", "upright"
//   [hardpoint]                          # x forward, y left, z up
//   uca_front = ["1648.347 mm", "273.206 mm", "303.434 mm"]
//   # and uca_rear, lca_front, lca_rear, ubj, lbj, pushrod_inner, pushrod_outer, trackrod_inner,
//   # trackrod_outer, wheel_center, contact
//   [bushing.all]                        # of every joint that does not say otherwise
//   x = "30 kN/mm"                       # y, z: the same
//   about_x = "200 N m/rad"              # about_y, about_z
//   [bushing.ubj]
//   y = "12 kN/mm"
//
// In the place of [hardpoint] may stand, before all tables, hardpoints = "hardpoints.csv" and of
// several corners in it hardpoints_of = "FL" (formats/car/hardpoint_table.h): whoever reads the
// file puts them there. Bushings are for statics; the kinematics have points of their own
// (geometry_reader.h). Of five links they are [bushing.NAME_inner] and [bushing.NAME_outer] of each
// link, pushrod_inner and pushrod_outer (compliant_corner.h).
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/document.h"
#include "models/suspension/compliant_corner.h"

namespace latsch::suspension {

struct Corner {
  CornerGeometry geometry;
  std::optional<CompliantCorner> compliant;  // none without [bushing]
  std::optional<DoubleWishbone> statics;     // what that is made of; none of five links
};

/// InputError naming the place, or the part that is no suspension.
Corner read_corner(const Node& root);
/// Its double wishbone with bushings; InputError also where it has none.
DoubleWishbone read_suspension(const Node& root);

/// Which stiffnesses the number at a path of the file is, by joint of these and x, y, z, about_x:
/// several for one of [bushing.all], none for what is no stiffness.
std::vector<std::pair<int, int>> stiffnesses_at(const Document& numbers,
                                                const std::string& path,
                                                const std::vector<multibody::Joint>& joints);
/// Whether a number at this path is one of the stiffnesses that stiffnesses_at() finds: not those
/// of curves, play, friction.
bool is_stiffness(const std::string& path);

}  // namespace latsch::suspension
