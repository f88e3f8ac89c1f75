// SPDX-License-Identifier: Apache-2.0
// Uniaxial law of a cord layer, with one modulus in tension, another in compression, and a smooth
// transition.
//   S = S0 + E_c e + (E_t - E_c) m(e),   m(e) = (e + sqrt(e^2 + w^2) - w) / 2
// S is the stress, e = (lambda^2 - 1) / 2 the strain of the full stretch lambda along the cord. The
// function m replaces max(e, 0); m(0) = 0, so S(0) = S0. The tangent is within 0.3 % of E_t from e
// = 10 w on.
#pragma once

#include "models/fe_tire/mesh/materials.h"

namespace latsch::fe_tire {

/// Width w of the transition between compression and tension, as a strain. A larger w changes the
/// stress of cords at small strain; a smaller one slows down Newton's method. The value is far
/// below the strain of an inflated belt (about 2e-3).
inline constexpr double kCordTransition = 1e-4;

struct CordStress {
  double S = 0.0;        // second Piola-Kirchhoff stress along the cord, Pa
  double tangent = 0.0;  // dS/de, Pa
};
/// Returns stress and tangent at the strain e, as the elements compute them (hex8_cords.h).
CordStress stress(const CordLayer& layer, double e);

}  // namespace latsch::fe_tire
