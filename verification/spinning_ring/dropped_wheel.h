// SPDX-License-Identifier: Apache-2.0
// A free wheel that falls on the ground, against CalculiX 2.20 (*DYNAMIC): a plane-strain ring on a
// stiff rim, without and with a spin, on the same mesh and with the same law of contact, a spring
// at every node of the tread. CalculiX follows the material; here the mesh stands and the material
// runs through it, by (W.1) in the steps of bossak_step.h.
#pragma once

#include <vector>

namespace latsch::verification {

/// The load at times that are half a millisecond apart, from 0.5 ms on.
struct DroppedWheel {
  std::vector<double> Fz;  // N
  double impulse = 0.0;    // N s, of the whole run
};
inline constexpr double kDropInterval = 5e-4;  // s

/// Returns the results of CalculiX with steps of at most 0.1 ms, and those with at most 0.2 ms, for
/// a wheel without spin or with kDropSpin.
struct ListedDrop {
  DroppedWheel by_short_steps;
  std::vector<double> by_long_steps;  // N
};
inline constexpr double kDropSpin = 60.0;  // rad/s
const ListedDrop& listed_drop(bool spins);

inline constexpr double kDropEnd = 0.0262;  // s, end of the listed impulses
/// Drops the wheel in steps of `step`, s, up to `end`, s. kDropInterval has to be a multiple of it.
DroppedWheel drop_wheel(bool spins, double step, double end = kDropEnd);

/// Relative errors against the short steps of CalculiX: of the impulse; the rms of the load's error
/// over the load's own, at the listed times, and of its means over four of them, the time in which
/// a sector of the spinning wheel passes.
struct DropErrors {
  double impulse = 0.0, load = 0.0, load_of_passages = 0.0;
};
DropErrors drop_errors(bool spins, const DroppedWheel& found);

}  // namespace latsch::verification
