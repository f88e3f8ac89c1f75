// SPDX-License-Identifier: Apache-2.0
// What a flexible ring remembers from one step to the next: a value, copied, compared, stored. Of
// the tread the patch alone is in it.
#pragma once

#include "models/ring_tire/belt/rim_frame.h"
#include "models/ring_tire/belt/section_bending.h"
#include "models/ring_tire/belt/sidewall.h"
#include "models/ring_tire/tread/tread_contact.h"

namespace latsch::ring_tire {

struct RingState {
  WheelMotion motion;                    // of the rim
  NodeValues place, rate, acceleration;  // of the nodes: m, rad; per s; per s^2
  NodeValues force;                      // f of (15), N, N m
  SidewallForces::Memory sidewall;
  TreadMemory tread;
  SectionBending::Field section;  // γ of (23), m

  bool operator==(const RingState&) const = default;
};

}  // namespace latsch::ring_tire
