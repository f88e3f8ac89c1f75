// SPDX-License-Identifier: Apache-2.0
// Frequencies of the ring that have a closed form: what the modes have to come to, and where the
// search for stiffnesses starts.
#pragma once

#include "models/ring_tire/description/ring_parameters.h"

namespace latsch::ring_tire {

/// Hz, in the plane, of the inextensible ring under pressure p on a foundation k_w, k_v:
///   ω_n² = ((EI/R⁴) n²(n²-1)² + (p b/R) n²(n²-1) + k_v + n² k_w)/(ρA (1 + n²))
double in_plane_frequency(const RingParameters& ring, int n);
/// Hz, rigid ring sideways: ω² = k_y/ρA.
double lateral_frequency(const RingParameters& ring);
/// Hz, rigid ring tilting: ω² = (k_y r² + c_ψ (1 - λ r)² + T0)/(ρA r² + J), per length, T0 the
/// tension under pressure, which the plane of the rim keeps.
double tilt_frequency(const RingParameters& ring);

}  // namespace latsch::ring_tire
