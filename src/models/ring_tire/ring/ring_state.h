// SPDX-License-Identifier: Apache-2.0
// State of a flexible ring between two steps, as a value that can be copied, compared and stored.
// Of the tread it contains only the blocks in the contact patch.
#pragma once

#include "models/ring_tire/belt/rim_frame.h"
#include "models/ring_tire/belt/section_bending.h"
#include "models/ring_tire/belt/sidewall.h"
#include "models/ring_tire/tread/tread_contact.h"

namespace latsch::ring_tire {

struct RingState {
  WheelMotion motion;  // motion of the rim
  // position, rate and acceleration of the nodes: m, rad; per s; per s^2
  NodeValues place, rate, acceleration;
  NodeValues force;  // f of (15), N, N m
  SidewallForces::Memory sidewall;
  TreadMemory tread;
  SectionBending::Field section;  // γ of (23), m

  bool operator==(const RingState&) const = default;
};

}  // namespace latsch::ring_tire
