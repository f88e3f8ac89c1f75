// SPDX-License-Identifier: Apache-2.0
// A ring of the size 205/55 R16 for tests and benchmarks, with numbers of the order of a passenger
// tire's.
#pragma once

#include "models/ring_tire/description/ring_parameters.h"

namespace latsch::ring_tire {

inline RingParameters passenger_ring() {
  RingParameters ring;
  ring.nodes = 80;
  ring.belt = {.radius = 0.305,
               .mass = 4.5,
               .torsion_inertia = 0.006,
               .extension = 2.0e6,
               .bending_in_plane = 1.8,
               .bending_out_of_plane = 88.0,
               .twist = 97.0,
               .pressure = 2.4e5,
               .pressure_width = 0.08};
  ring.sidewall.radial = {.stiffness = 5.5e5, .damping = 60.0};
  ring.sidewall.tangential = {.stiffness = 2.7e5, .damping = 140.0};
  ring.sidewall.lateral = {.stiffness = 1.6e5, .damping = 90.0};
  ring.sidewall.torsion = 5.0e3;
  ring.sidewall.torsion_damping = 1.0;
  ring.tread = {.lines = 6, .blocks = 10, .width = 0.16, .height = 0.011};
  return ring;
}

}  // namespace latsch::ring_tire
