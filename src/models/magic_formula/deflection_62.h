// SPDX-License-Identifier: Apache-2.0
// Deflection of a tire in MF 6.2, where it depends on camber and side force. It is found by a
// search in steps and the secant method, for one state at a time. The deflections of MF 5.2 and 6.1
// have a closed form in geometry.h.
#pragma once

#include "models/magic_formula/tire_constants.h"

namespace latsch::magic_formula {

/// Variables of a state on which the deflection depends.
template <class R>
struct WheelUnderLoadOf {
  R Fz, Fz_given;  // N, load: limited to the range of the file; as given
  R omega, gamma;  // rad/s, rad
  R dpi;           // (4.E2b)
  R R_omega;       // m, free radius of the rolling tire at this speed
};
using WheelUnderLoad = WheelUnderLoadOf<double>;

struct Deflection62 {
  double rho, R_l;  // m
  bool carried;     // true if there is a radius at which the tire carries the load
};

Deflection62 deflection_62(const TireConstants& tire,
                           const WheelUnderLoad& o,
                           double Fx,
                           double Fy);

/// Returns the deflection with its derivatives: dR_l = (dF - dFz)/(-dF/dR_l). `spare` is a
/// direction of derivatives that no other quantity uses.
struct DualDeflection62 {
  DualNumber rho, R_l;
};
DualDeflection62 deflection_62(const TireConstants& tire,
                               const TireConstantsOf<DualNumber>& dual_tire,
                               const WheelUnderLoadOf<DualNumber>& o,
                               const DualNumber& Fx,
                               const DualNumber& Fy,
                               int spare,
                               SlopeArena& arena);

}  // namespace latsch::magic_formula
