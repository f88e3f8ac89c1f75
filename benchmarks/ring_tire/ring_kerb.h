// SPDX-License-Identifier: Apache-2.0
// Rows of bench_ring_speed: a ring tire over a kerb, four of them under a car, and a drum instead
// of a road.
#pragma once

#include "models/ring_tire/description/ring_parameters.h"
#include "table.h"

namespace latsch::benchmarks {

/// Effort of a timing: the number of repetitions, of which the fastest counts, and the simulated
/// duration of rolling.
struct RingRounds {
  int count = 15;
  double duration = 0.09;  // s
};

/// Returns the ring of a passenger tire whose sidewall has viscoelastic memory.
ring_tire::RingParameters ring_of(int nodes, int blocks, int lines);

/// Adds one ring in time steps of 0.2 ms, at 60 m/s over a kerb 25 mm deep and at 40 m/s over one
/// 25 mm high, with its error compared with the refined solution; and a ring of 80 segments x 50
/// blocks x 10 lines in steps of 0.5 ms.
void kerb_rows(Table& table, const RingRounds& rounds);
/// Adds four wheels of a car in time steps of 0.2 ms, two over the deep kerb and two beside it:
/// four states that use the memory of one tire model in turn.
void car_row(Table& table, const RingRounds& rounds);
/// Adds the derivatives of a run over the deep kerb: their error compared with differences, and
/// their cost.
void slopes_rows(Table& table, const RingRounds& rounds);
/// Adds a wheel that spins freely over the deep kerb and one whose axle moves too, compared with a
/// wheel whose motion is prescribed.
void free_wheel_rows(Table& table, const RingRounds& rounds);
/// Adds the time with a tread whose rubber bottoms out, compared with linear rubber.
void bottoming_rows(Table& table, const RingRounds& rounds);
/// Adds the time on a smooth drum, compared with a flat road.
void drum_row(Table& table, const RingRounds& rounds);

}  // namespace latsch::benchmarks
