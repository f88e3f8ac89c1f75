// SPDX-License-Identifier: Apache-2.0
// The deflection of MF 6.2, which depends on camber and side force, by a stepwise search and the
// secant method: one state at a time, in plain doubles. The deflections of 5.2 and 6.1 have a
// closed form in geometry.h.
#pragma once

#include "models/magic_formula/tire_constants.h"

namespace latsch::magic_formula {

/// The variables of a state that the deflection depends on.
template <class R>
struct WheelUnderLoadOf {
  R Fz, Fz_given;  // N, limited; as given
  R omega, gamma;  // rad/s, rad
  R dpi;           // (4.E2b)
  R R_omega;       // m, free radius at speed
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

/// Returns the deflection with slopes: dR_l = (dF - dFz)/(-dF/dR_l). `spare` is a direction in
/// which nothing else has slopes.
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
