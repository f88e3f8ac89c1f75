// SPDX-License-Identifier: Apache-2.0
// Uniaxial law of a cord layer: one modulus in tension, another in compression, smooth between
// them.
//   S = S0 + E_c e + (E_t - E_c) m(e),   m(e) = (e + sqrt(e^2 + w^2) - w) / 2
// with e = (lambda^2 - 1) / 2 of the full stretch lambda along the cord. m replaces max(e, 0): m(0)
// = 0, so S(0) = S0. The tangent is within 0.3 % of E_t from e = 10 w on.
#pragma once

#include "models/fe_tire/element/materials.h"

namespace latsch::fe_tire {

/// Width w of the transition. A larger w changes the stress of cords at small strain; a smaller one
/// hinders Newton's method. It is far below the strain of an inflated belt (about 2e-3).
inline constexpr double kCordTransition = 1e-4;

struct CordStress {
  double S = 0.0;        // second Piola-Kirchhoff stress along the cord, Pa
  double tangent = 0.0;  // dS/de, Pa
};
/// Returns the stress as the elements compute it (hex8_cords.h).
CordStress stress(const CordLayer& layer, double e);

}  // namespace latsch::fe_tire
