// SPDX-License-Identifier: Apache-2.0
// Reads the kinematics of a corner from its file. In addition to the points of suspension_reader.h
// the file may contain:
//
//   type = "double_wishbone"             # or "five_link", whose links replace uca_front ...
//                                        # trackrod_outer:
//   [link.NAME]                          # five of them
//   inner = ["0 mm", "300 mm", "200 mm"]
//   outer = ["0 mm", "600 mm", "180 mm"]
//   trackrod = "NAME"                    # before the tables; the last link unless given
//
//   [hardpoint]                          # optional; without a rocker the spring is between
//   rocker_pivot = [...]                 # pushrod_inner and pushrod_outer
//   rocker_axis = [...]                  # a second point of its axis; if not given, the axis is
//                                        # normal to the plane of pushrod_inner, pivot and damper
//   rocker_damper = [...]                # ends of spring and damper
//   damper_chassis = [...]
//   rocker_arb_link = [...]              # link to the anti-roll bar
//   arb_link_blade = [...]
//   arb_center = [...]                   # on its axis, which is along y
//   [wheel]                              # at rest
//   toe = "0 deg"
//   camber = "-1 deg"
//   [spring]                             # for wheel rate, ride rate and ride frequency
//   stiffness = "50 N/mm"
//   sprung_mass = "70 kg"                # that this corner carries at rest
//   tire_stiffness = "120 N/mm"
#pragma once

#include <string>

#include "base/document.h"
#include "models/suspension/corner_geometry.h"

namespace latsch::suspension {

/// Reads a point such as ["1648.347 mm", "273.206 mm", "303.434 mm"].
Eigen::Vector3d read_point(const Node& points, const char* name);

/// Reads the geometry of a corner. Throws InputError if a key is missing. The returned geometry may
/// still have a fault().
CornerGeometry read_geometry(const Node& root);

}  // namespace latsch::suspension
