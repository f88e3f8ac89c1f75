// SPDX-License-Identifier: Apache-2.0
// State of a flexible ring between two steps: a value that is copied, compared and stored. Only the
// contact patch of the tread is part of it.
#pragma once

#include "models/ring_tire/belt/rim_frame.h"
#include "models/ring_tire/belt/section_bending.h"
#include "models/ring_tire/belt/sidewall.h"
#include "models/ring_tire/tread/tread_contact.h"

namespace latsch::ring_tire {

struct RingState {
  WheelMotion motion;                    // motion of the rim
  NodeValues place, rate, acceleration;  // values of the nodes: m, rad; per s; per s^2
  NodeValues force;                      // f of (15), N, N m
  SidewallForces::Memory sidewall;
  TreadMemory tread;
  SectionBending::Field section;  // γ of (23), m

  bool operator==(const RingState&) const = default;
};

}  // namespace latsch::ring_tire
