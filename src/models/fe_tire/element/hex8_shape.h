// SPDX-License-Identifier: Apache-2.0
// Quantities of an element computed once from its reference coordinates.
//
// The parent cube is (xi, eta, zeta) in [-1, 1]^3, with nodes in the order of mesh.h and 2x2x2
// Gauss points of weight 1. Strain and stress at a Gauss point are written in the cylindrical triad
// of the spin axis there (radial, circumferential, axial; see materials.h).
#pragma once

#include <Eigen/Core>
#include <array>

#include "models/fe_tire/element/hex8.h"

namespace latsch::fe_tire {

inline constexpr double kGauss = 0.57735026918962576451;  // 1 / sqrt(3)
/// Signs of a node's parent coordinates. The Gauss points have the same order, at kGauss times
/// these.
inline constexpr double kXi[8] = {-1, 1, 1, -1, -1, 1, 1, -1};
inline constexpr double kEta[8] = {-1, -1, 1, 1, -1, -1, 1, 1};
inline constexpr double kZeta[8] = {-1, -1, -1, -1, 1, 1, 1, 1};

using Vector8 = Eigen::Matrix<double, 8, 1>;

/// Strain operators of the solid-shell; hex8_solid_shell_kernel.h explains the letters. Vectors
/// over the nodes are written in the modal vectors h_m (hex8_solid_shell_modes.h): v = sum_m v[m]
/// h_m.
template <class Number>
struct SolidShellOperators {
  static constexpr int kModes = 7;
  static constexpr int kStrains = 18;  // E_c (6) and e (12), the generalized strains
  static constexpr int kEnhanced = 8;  // alpha
  static constexpr int kSquares = 7;   // see solid_shell::kSquares
  static constexpr int kColumns = kStrains + kEnhanced;

  Number b[kModes][3];      // 1/m, mean gradients of the shape functions in the center's triad
  Number gamma[kModes][3];  // hourglass vectors, z_j = sum_m x_m gamma[m][j]
  /// Weights of F a_j = sum_m x_m along[m][j], with unit vectors a_j along xi, across it and normal
  /// to both.
  Number along[kModes][3];
  Number w[6][kSquares];     // 1/m^2, contribution to E_c of the squares of z_m along the axes
  Number P[8][6][kColumns];  // E[point][r] = sum_j P[point][r][j] (E_c, e, alpha)_j
};

struct SolidShellShape : SolidShellOperators<double> {
  double e0[12];  // m^2, reference values of e
  double volume;  // m^3
  double L2[2];   // m^2, |X_1|^2 and |X_2|^2
  /// Dyads (Voigt, of stress) of the element's axes meridional 2 and normal 3 in the center's
  /// triad.
  Vector6 d22, d33, d23, d13;
  double length, thickness;  // m, along eta and zeta
};

struct HexShape {
  ElementKind kind = ElementKind::full_integration;
  Matrix38 X;                // m
  std::array<double, 8> dV;  // m^3, volume of a Gauss point; not positive if inverted
  double dN[8][3][8];        // 1/m, [point][direction][node], gradients in the point's triad
  // Filled only for the solid-shell. `rough` repeats the operators in single precision, for rough
  // tangents.
  SolidShellShape solid_shell;
  SolidShellOperators<float> rough;
};

/// Returns the shape functions at a point of the parent cube.
Vector8 shape_functions(double xi, double eta, double zeta);
/// Returns the derivatives of the shape functions by xi, eta, zeta (rows).
Matrix38 parent_gradients(double xi, double eta, double zeta);
/// Returns columns radial, circumferential, axial at X. On the spin axis, where they are undefined,
/// those of the bottom are used.
Eigen::Matrix3d cylindrical_triad(const Eigen::Vector3d& X);

}  // namespace latsch::fe_tire
