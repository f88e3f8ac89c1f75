// SPDX-License-Identifier: Apache-2.0
// A disc ring whose material relaxes turns below a force that stands. The ring is that of
// gyro_ring.inp with moduli that are 0.8 of the listed ones when relaxed, and one Prony term up to
// the listed ones. 10 N press radially on the four outer nodes of each plane, spread around as
// (1 + cos(pi theta/40 deg))/2. Used by the tests of this folder and the benchmark
// `rolling_losses`.
#pragma once

#include <vector>

namespace latsch::verification {

struct TurnedDisc {
  double displacement;  // m, inward, mean of the outer nodes at theta = 0, by the force
  double moment;        // N m, power that the turning ring takes from the force over the spin
  double by_losses;     // N m, power that the histories lose over the spin
  int passes;           // iterations of Newton's method
};
/// Returns the equilibrium at 50 rad/s; `tau` in s.
TurnedDisc turned_disc(int sectors, double tau);

/// Results of an independent program (HEX8, whole ring) for 50 rad/s.
struct ListedDisc {
  int sectors;
  double tau;                   // s
  double displacement, moment;  // m, N m
};
const std::vector<ListedDisc>& listed_discs();

}  // namespace latsch::verification
