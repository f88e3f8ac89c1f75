// SPDX-License-Identifier: Apache-2.0
// Reads the file of a flexible ring tire. Every number has its unit and can be a design variable.
//
//   kind = "ring_tire"
//   side = "left"                      # of the car, as it was measured: default; or "right". A car
//                                      # puts its mirror image on the other side
//   pressure = "2.4 bar"
//
//   [belt]
//   nodes = 80
//   radius = "305 mm"                  # at rest, inflated
//   mass = "4.52 kg"                   # with the tread
//   torsion_inertia = "0.006 kg m"     # of the section about the circumference, per length
//   extension = "2 MN"                 # EA
//   bending_in_plane = "1.8 N m^2"     # EI about the axle
//   bending_out_of_plane = "88 N m^2"  # EI about the radius
//   twist = "97 N m^2"                 # per radian and length
//   bending_twist = "0 N m^2"          # D16 of the plies, which makes ply steer; default 0
//   conicity = "0 deg"                 # of the sections at rest, positive: smaller left; default 0
//   damping_time = "0.1 ms"            # damping over stiffness of bending and twist; default 0
//   extension_damping_time = "0 ms"    # of extension, which is the cords'; default 0
//   pressure_width = "80 mm"           # of the section whose pressure the belt's tension carries
//   bending_across = "10 N m"          # of the section across, per length; default 0: straight
//   section_coupling = 1               # of the belt's tension that smooths bent sections; default
//   gravity = "9.81 m/s^2"             # of the belt; default 0: as on a tared rig
//
//   [sidewall]
//   time_constant = "15 ms"            # of dynamic stiffening
//   torsion = "5 kN/rad"
//   torsion_damping = "1 N s/rad"
//   torsion_by_lateral = "0 rad/m"
//   progressivity = 1.2                # radial slope: from k to k (1 + 1.2)
//   progressive_travel = "15 mm"       # where half of that is reached
//   pressure_share = 0                 # of the stiffnesses below that is the pressure's,
//   reference_pressure = "2.4 bar"     # at this pressure; the rest is the sidewall's own
//   rim = {travel = "80 mm", stiffness = "5 MN/m^2"}   # inward, until the belt lies on it; none
//   [sidewall.radial]                  # and tangential, lateral; per length of circumference
//   stiffness = "0.55 MN/m^2"
//   damping = "60 N s/m^2"
//   dynamic_stiffening = 0.2
//   friction_stiffening = 0            # of dry friction, with its force
//   friction_force = "0 N/m"
//
//   [tread]
//   lines = 6                          # across the width
//   blocks = 10                        # of one line on one segment
//   width = "160 mm"
//   height = "11 mm"
//   crown_radius = "800 mm"            # none: flat
//   shore_a = 66                       # or young_modulus = "4.9 MPa"
//   positive = 0.65
//   bottoming = 1                      # of the height: pressed by as much rubber bottoms out;
//                                      # 1 - positive where it fills voids; default 0: it is linear
//   shear_ratio = 0.33
//   damping_time = "0.1 ms"
//   [tread.friction]                   # optional: μ at low, medium and high pressure
//   pressure = ["0.5 bar", "2 bar", "5 bar"]
//   adhesion = [1.2, 1.1, 1.0]         # and maximum, sliding, blocking
//   maximum_speed = "0.3 m/s"          # and sliding_speed, blocking_speed
//
//   [uniformity]                       # optional: what is not the same all around
//   imbalance = "20 g"                 # on the belt, at
//   imbalance_angle = "30 deg"         # from the lowest point at spin 0 to the front; default 0
//   radial_runout = ["0.3 mm", "0.1 mm"]        # of the tread: amplitudes of harmonics 1, 2 ...
//   radial_runout_angle = ["0 deg", "45 deg"]   # where each is largest; default 0
//   lateral_runout = ["0.4 mm"]        # of the belt at rest, to the left; lateral_runout_angle
#pragma once

#include "base/document.h"
#include "models/ring_tire/description/ring_parameters.h"

namespace latsch::ring_tire {

/// Throws InputError naming the place, what was found and what was expected; unknown keys too.
RingParameters read_ring_tire(const Node& root);

/// Returns Young's modulus, Pa, of rubber of that hardness: E = 10^(5.33905 + 0.020477 S) [Gipser,
/// FTire documentation].
double young_modulus_of_shore_a(double hardness);

}  // namespace latsch::ring_tire
