// SPDX-License-Identifier: Apache-2.0
// Materials of the elements: rubber, smeared composites and cord layers.
//
// The Voigt order is 11, 22, 33, 12, 23, 13 everywhere. Shear strains are engineering strains (2
// E12).
#pragma once

#include <Eigen/Core>
#include <variant>
#include <vector>

namespace latsch::fe_tire {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

namespace voigt {

/// Row and column (i, j) of each Voigt index, and the Voigt index of each pair (i, j).
inline constexpr int kRow[6] = {0, 1, 2, 0, 1, 0}, kColumn[6] = {0, 1, 2, 1, 2, 2};
inline constexpr int kPlace[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};

}  // namespace voigt

/// Nearly incompressible rubber; C01 = 0 is neo-Hooke:
///   W = C10 (I1bar - 3) + C01 (I2bar - 3) + K/2 (J - 1)^2
/// Small strain: shear modulus 2 (C10 + C01), bulk modulus K. All in Pa.
struct Hyperelastic {
  double C10 = 0.0;
  double C01 = 0.0;
  double K = 0.0;

  /// Returns neo-Hooke rubber with Young's modulus E (Pa) and Poisson's ratio nu. If `ratio` = C01
  /// / C10 is not 0, the rubber is of the Mooney-Rivlin kind.
  static Hyperelastic from_young_modulus(double E, double nu, double ratio = 0.0);
};

/// St. Venant-Kirchhoff law S = D E, with the stiffness D in Pa. At every Gauss point it is
/// expressed in cylindrical axes (radial, circumferential, axial). Circumferential is the direction
/// of increasing theta, and axial = radial x circumferential.
struct StVenantKirchhoff {
  Matrix6 D = Matrix6::Zero();

  /// Returns an isotropic law with Lame's constants: shear modulus G and lambda, Pa.
  static StVenantKirchhoff isotropic(double G, double lambda);
};

struct Solid {
  std::variant<Hyperelastic, StVenantKirchhoff> law;
  double density = 0.0;  // kg/m^3
};

/// Parallel cords, modeled as a membrane that carries stress only along the cords,
///   S = S0 + E_c e + (E_t - E_c) m(e),   e = (lambda^2 - 1) / 2
/// with the full stretch lambda and m of cord_law.h.
struct CordLayer {
  double E_tension = 0.0;      // Pa, modulus of the cord in tension
  double E_compression = 0.0;  // Pa
  double thickness = 0.0;      // m, cross-section of a cord divided by the spacing
  double angle = 0.0;          // rad, from the circumference (xi) toward +eta
  double pretension = 0.0;     // Pa, second Piola-Kirchhoff stress at e = 0
  double density = 0.0;        // kg/m^3, density of the cord
};

struct Materials {
  std::vector<Solid> solids;
  std::vector<CordLayer> layers;
};

}  // namespace latsch::fe_tire
