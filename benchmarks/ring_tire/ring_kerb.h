// SPDX-License-Identifier: Apache-2.0
// Rows of ring_speed: the ring over a kerb, four of them under a car, a drum in place of a road.
#pragma once

#include "models/ring_tire/description/ring_parameters.h"
#include "table.h"

namespace latsch::benchmarks {

/// Number of repetitions of a timing, of which the fastest counts, and the duration of rolling.
struct RingRounds {
  int count = 15;
  double duration = 0.09;  // s
};

/// Returns a passenger tire's ring with memory in its sidewall.
ring_tire::RingParameters ring_of(int nodes, int blocks, int lines);

/// Adds one ring in steps of 0.2 ms at 60 m/s over a kerb 25 mm deep and at 40 m/s over one 25 mm
/// high, its error compared with the refined solution, and 80 segments x 50 blocks x 10 lines in
/// steps of 0.5 ms.
void kerb_rows(Table& table, const RingRounds& rounds);
/// Adds two rings over the deep kerb and two beside it, in steps of 0.2 ms: four states that take
/// turns with one tire's memory.
void car_row(Table& table, const RingRounds& rounds);
/// Adds the derivatives of trials over the deep kerb, compared with differences, and their cost.
void slopes_rows(Table& table, const RingRounds& rounds);
/// Adds a wheel over the deep kerb that spins freely, and one whose axle moves too, compared with
/// one whose motion is prescribed.
void free_wheel_rows(Table& table, const RingRounds& rounds);
/// Adds a tread that bottoms out, compared with linear rubber.
void bottoming_rows(Table& table, const RingRounds& rounds);
/// Adds a smooth drum, compared with a flat road.
void drum_row(Table& table, const RingRounds& rounds);

}  // namespace latsch::benchmarks
