// SPDX-License-Identifier: Apache-2.0
// Frequencies of the ring in closed form. Computed modes have to converge to them, and the search
// for stiffnesses starts from them.
#pragma once

#include "models/ring_tire/description/ring_parameters.h"

namespace latsch::ring_tire {

/// Returns the in-plane frequency, Hz, of the inextensible ring under pressure p on a foundation
/// k_w, k_v:
///   ω_n² = ((EI/R⁴) n²(n²-1)² + (p b/R) n²(n²-1) + k_v + n² k_w)/(ρA (1 + n²))
double in_plane_frequency(const RingParameters& ring, int n);
/// Returns the lateral frequency of the rigid ring, Hz: ω² = k_y/ρA.
double lateral_frequency(const RingParameters& ring);
/// Returns the tilt frequency of the rigid ring, Hz: ω² = (k_y r² + c_ψ (1 - λ r)² + T0)/(ρA r² +
/// J), per length. T0 is the tension under pressure, which stays in the plane of the rim.
double tilt_frequency(const RingParameters& ring);

}  // namespace latsch::ring_tire
