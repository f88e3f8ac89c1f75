// SPDX-License-Identifier: Apache-2.0
// Rows of ring_speed: the ring over a kerb, four of them under a car, a drum in place of a road.
#pragma once

#include "models/ring_tire/description/ring_parameters.h"
#include "table.h"

namespace latsch::benchmarks {

/// A passenger tire's ring with memory in its sidewall.
ring_tire::RingParameters ring_of(int nodes, int blocks, int lines);

/// One ring in steps of 0.2 ms at 60 m/s over a kerb 25 mm deep and at 40 m/s over one 25 mm high,
/// and how far it is from the refined solution, beside 80 segments x 50 blocks x 10 lines in steps
/// of 0.5 ms.
void kerb_rows(Table& table);
/// Two rings over the deep kerb, two beside it, in steps of 0.2 ms: four states that take turns
/// with one tire's memory.
void car_row(Table& table);
/// Over the deep kerb: the derivatives of trials, beside differences, and what they cost.
void slopes_rows(Table& table);
/// Over the deep kerb: a wheel that spins freely, then on an axle that moves too, beside one whose
/// motion is told.
void free_wheel_rows(Table& table);
/// Tread that bottoms out, beside linear rubber.
void bottoming_rows(Table& table);
/// A smooth drum, beside a flat road.
void drum_row(Table& table);

}  // namespace latsch::benchmarks
