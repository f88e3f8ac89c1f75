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
  /// Sign of the inclination in the spin (4.76), for axes with z up. False: minus, as in MFeval, by
  /// which the camber force has the opposite sign of that without turn slip. True: plus, as the
  /// book's axes with z down and (4.89) require: the camber force is the same with turn slip and
  /// without, and a tire that leans into its turn has less spin. The same holds for the residual
  /// torque, (4.93) and (4.99).
  bool spin_of_book = false;
  /// Factor A_mu of the decrease of friction with sliding speed (4.E8). The book suggests 10;
  /// MF-Tyre uses 1.
  double A_mu = 1.0;
  /// True if the tire is mounted on the side of the car opposite to that for which it was measured.
  /// Then alpha, gamma, phit, Fy, Mx and Mz change their signs.
  bool mirrored = false;
};

}  // namespace latsch::magic_formula
