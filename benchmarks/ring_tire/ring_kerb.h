// SPDX-License-Identifier: Apache-2.0
// Rows of ring_speed: the ring over a kerb, four of them under a car, a drum in place of a road.
#pragma once

#include "models/ring_tire/description/ring_parameters.h"
#include "table.h"

namespace latsch::benchmarks {

/// How often a time is taken, of which the least counts, and how long the ring rolls.
struct RingRounds {
  int count = 15;
  double duration = 0.09;  // s
};

/// A passenger tire's ring with memory in its sidewall.
ring_tire::RingParameters ring_of(int nodes, int blocks, int lines);

/// One ring in steps of 0.2 ms at 60 m/s over a kerb 25 mm deep and at 40 m/s over one 25 mm high,
/// and how far it is from the refined solution, beside 80 segments x 50 blocks x 10 lines in steps
/// of 0.5 ms.
void kerb_rows(Table& table, const RingRounds& rounds);
/// Two rings over the deep kerb, two beside it, in steps of 0.2 ms: four states that take turns
/// with one tire's memory.
void car_row(Table& table, const RingRounds& rounds);
/// Over the deep kerb: the derivatives of trials, beside differences, and what they cost.
void slopes_rows(Table& table, const RingRounds& rounds);
/// Over the deep kerb: a wheel that spins freely, then on an axle that moves too, beside one whose
/// motion is told.
void free_wheel_rows(Table& table, const RingRounds& rounds);
/// Tread that bottoms out, beside linear rubber.
void bottoming_rows(Table& table, const RingRounds& rounds);
/// A smooth drum, beside a flat road.
void drum_row(Table& table, const RingRounds& rounds);

}  // namespace latsch::benchmarks
