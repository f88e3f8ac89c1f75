// SPDX-License-Identifier: Apache-2.0
// Modes of the unloaded ring with the rim fixed. In axes that rotate with the angle of the node the
// ring at rest is the same everywhere, so its modes are waves around it. For each circumferential
// number n
//   (K(n) - ω^2 M) φ = 0,  K(n) = sum over j of K_0j exp(2πi n j/N),  4 x 4, Hermitian.       (20)
// Damping and dynamic stiffening are taken at the mode's own frequency, to first order in the
// shape:
//   ω^2 = ω_K^2 + φ* K_M φ (ωτ)^2/(1 + (ωτ)^2),  2 D ω = φ* (C + K_M τ/(1 + (ωτ)^2)) φ        (21)
// Imbalance and run-out are not included. Friction elements stick, because vibrations are small.
// Motions in the plane of the rim and out of it are independent, unless the plies couple them (32)
// or the belt is a cone (33).
#pragma once

#include <vector>

#include "models/ring_tire/description/ring_parameters.h"

namespace latsch::ring_tire {

/// A vibration mode of the unloaded ring with fixed rim, off the ground.
struct RingMode {
  int n = 0;             // number of waves around the circumference
  bool lateral = false;  // true: lateral motion with torsion; false: motion in the plane of the rim
  int order = 1;         // 1, 2, ... among modes of the same n and plane, by frequency
  double frequency = 0.0;  // Hz, without damping
  double damping = 0.0;    // D, share of critical damping
  /// Amplitudes of u_r, u_t, u_y (m) and ψ (rad) for unit modal mass.
  std::array<double, 4> shape = {};
};

/// Frequency, Hz, and damping ratio of a mode by (21), from its ω_K^2, φ* C φ and φ* K_M φ.
struct DampedMode {
  double frequency, damping;  // Hz; share of critical damping
};
/// Returns frequency and damping ratio of a mode by (21). `squared`: ω_K^2, `damping`: φ* C φ,
/// `maxwell`: φ* K_M φ, `time_constant`: τ of the Maxwell elements, s.
DampedMode damped_mode(double squared, double damping, double maxwell, double time_constant);

/// Returns all modes with n = 0 .. most_waves, ordered by n, plane and order. Modes with n > 0 come
/// in pairs, listed once.
std::vector<RingMode> unloaded_modes(const RingParameters& ring, int most_waves);

/// Returns the mode with this circumferential number n, plane and order.
const RingMode& find_mode(const std::vector<RingMode>& modes, int n, bool lateral, int order = 1);

}  // namespace latsch::ring_tire
