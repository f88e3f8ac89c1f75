// SPDX-License-Identifier: Apache-2.0
// A synthetic drum rig with known properties, to test the processing of recordings: a drum with one
// cleat, a force that responds to each hit with damped modes, and a rig whose resonance (3-3)
// distorts the force that the load cell measures with a dummy rim.
//
//   P(w) = sum_m a_m w_m / (w_m^2 - w^2 + 2 i zeta_m w_m w)  exp(-(w tau)^2 / 2)      of one hit
//   real rim: P,   dummy rim: P TF
//
// Each hit is synthesized from its spectrum at its own time, which may lie between samples, so
// delays, resonance and rig are exact. tau = 15 mm / v, at least 1 ms, is the duration of the
// contact with the cleat and keeps the signal below half the sampling rate (1 kHz or more). Noise
// is Gaussian and white.
#pragma once

#include <cstdint>
#include <vector>

#include "measurement/channels.h"
#include "measurement/rig_response.h"

namespace latsch {

struct SyntheticMode {
  double frequency = 0.0;  // Hz
  double zeta = 0.0;
  double amplitude = 0.0;  // N, a_m: a hit causes a_m exp(-zeta w t) sin(w t)
};

struct SyntheticRun {
  std::vector<double> speeds;  // m/s, one for each plateau
  double hold = 20.0;          // s, length of each plateau
  /// Relative change of the speed from the beginning to the end of a plateau.
  double drift = 0.002;
  double load = 4000.0;  // N
  double growth = 0.3;   // exponent of the strength of hits over speed: (v / v_first)^growth
  std::vector<SyntheticMode> modes;
  double noise = 15.0;     // N
  bool dummy_rim = false;  // true: the force is distorted by the rig's response
  /// Number of the run; determines the noise and the initial angle of the drum.
  std::uint64_t number = 0;
};

struct SyntheticRig {
  double rate = 2000.0;        // Hz
  double circumference = 6.0;  // m, of the drum
  RigResponse response;
  std::uint64_t seed = 1;
};

/// Returns the channels time, speed, Fz and Fx. Fx is half of the fluctuation of Fz, with separate
/// noise.
Channels synthetic_run(const SyntheticRig& rig, const SyntheticRun& run);

/// Returns the times of the hits of that run, s.
std::vector<double> synthetic_hits(const SyntheticRig& rig, const SyntheticRun& run);

/// Simulates a hammer test of the rig: channels time, hammer, Fz; `hits` hits 2 s apart, each a
/// half sine of 1 ms, with noise in N on both.
Channels synthetic_hammer(const SyntheticRig& rig, int hits, double noise);

}  // namespace latsch
