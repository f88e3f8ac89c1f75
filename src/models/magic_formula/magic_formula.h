// SPDX-License-Identifier: Apache-2.0
// The Magic Formula: forces, moments, radii and contact patch of a tire in steady state;
// MF 5.2, 6.1 and 6.2, pure and combined slip, camber, inflation pressure, turn slip.
//
// Axes: ISO-W at the contact point (NOTATION.md). alpha > 0 gives Fy < 0, kappa = -1 is a locked
// wheel, Vsx = -kappa |Vx|. Sources and the points in which implementations differ:
// docs/magic_formula.md. The equations are in operating_point.h, longitudinal.h, lateral.h,
// aligning.h, moments.h and geometry.h. The source of the equations is compiled for one state and
// for eight states at a time, and for each kernel set (kernel_set.h).
#pragma once

#include <span>

#include "models/magic_formula/conventions.h"
#include "models/magic_formula/tire_constants.h"

namespace latsch::magic_formula {

using State = StateOf<double>;

/// Steady-state results for one state. Every field has the name and unit of
/// `magic_formula_columns`.
template <class R>
struct SteadyStateOf {
  R Fx, Fy, Fz;        // N
  R Mx, My, Mz;        // N m
  R R_e, R_l, rho;     // m: effective and loaded radius, deflection
  R a, b;              // m: half length and half width of the contact patch
  R t, Mzr;            // m: pneumatic trail; N m: residual torque
  R mux, muy, omega;   // 1, 1, rad/s
  R Kxk, Kya;          // N; N/rad: longitudinal slip stiffness and cornering stiffness
  R Cx, Cy, Cz;        // N/m: overall stiffnesses; the vertical one is a secant
  R sigma_x, sigma_y;  // m: relaxation lengths
};
using SteadyState = SteadyStateOf<double>;

/// Many states, stored as one column per field. All columns have the same length.
struct StateColumns {
  std::span<const double> Fz, kappa, alpha, gamma, phit, Vx, p;
};
struct ForceColumns {
  std::span<double> Fx, Fy, Mx, My, Mz;
};

class MagicFormula {
 public:
  explicit MagicFormula(const Parameters& parameters, const Conventions& conventions = {});

  const Parameters& parameters() const { return parameters_; }
  const Conventions& conventions() const { return conventions_; }

  SteadyState evaluate(const State& state) const;
  /// Evaluates many states, several times faster than one by one. The results are identical to the
  /// last bit.
  void evaluate(std::span<const State> states, std::span<SteadyState> results) const;
  /// Computes only the forces and moments of many states.
  void forces(const StateColumns& states, const ForceColumns& results) const;

  /// Returns the vertical force at a deflection, N, for all versions up to MF 6.2. It is the
  /// inverse of `rho` for horizontal forces Fx, Fy (N) and a spin omega (rad/s).
  double vertical_force(
      double rho, double omega, double gamma, double p, double Fx, double Fy) const;

 private:
  Parameters parameters_;
  TireConstants tire_;
  Conventions conventions_;
};

}  // namespace latsch::magic_formula
