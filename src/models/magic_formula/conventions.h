// SPDX-License-Identifier: Apache-2.0
// The points in which implementations of the Magic Formula differ, and the caller's choice.
#pragma once

namespace latsch::magic_formula {

enum class Angles {
  direct,   // alpha and gamma themselves are used (MF-Tyre)
  tangent,  // alpha* = tan(alpha) sgn(Vx), gamma* = sin(gamma) (4.E3, 4.E4)
};

struct Conventions {
  /// True: inputs are clamped to the ranges of the file, everything fades out below VXLOW, and E <=
  /// 1.
  bool limits = true;
  Angles angles = Angles::direct;
  /// Uses the spin terms zeta_0 ... zeta_8 of [Pacejka 2012, 4.3.3]; without effect on a tire whose
  /// file has no turn slip coefficients.
  bool turn_slip = false;
  /// Factor of the digressive friction (4.E8): the book suggests 10, MF-Tyre has 1.
  double A_mu = 1.0;
  /// True if the tire is mounted on the other side than it was measured for: alpha, gamma, phit,
  /// Fy, Mx, Mz change sign.
  bool mirrored = false;
};

}  // namespace latsch::magic_formula
