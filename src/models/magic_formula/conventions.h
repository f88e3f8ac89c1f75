// SPDX-License-Identifier: Apache-2.0
// Points in which implementations of the Magic Formula differ, as options that the caller chooses.
#pragma once

namespace latsch::magic_formula {

enum class Angles {
  direct,   // alpha and gamma themselves are used (MF-Tyre)
  tangent,  // alpha* = tan(alpha) sgn(Vx), gamma* = sin(gamma) (4.E3, 4.E4)
};

struct Conventions {
  /// True: the inputs are clamped to the ranges of the file, forces fade out at speeds below VXLOW,
  /// and E <= 1.
  bool limits = true;
  Angles angles = Angles::direct;
  /// True: the spin terms zeta_0 ... zeta_8 of [Pacejka 2012, 4.3.3] are included. They have no
  /// effect if the file has no coefficients of turn slip.
  bool turn_slip = false;
  /// Factor A_mu of the decrease of friction with sliding speed (4.E8). The book suggests 10;
  /// MF-Tyre uses 1.
  double A_mu = 1.0;
  /// True if the tire is mounted on the side of the car opposite to that for which it was measured.
  /// Then alpha, gamma, phit, Fy, Mx and Mz change their signs.
  bool mirrored = false;
};

}  // namespace latsch::magic_formula
