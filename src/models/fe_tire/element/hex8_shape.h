// SPDX-License-Identifier: Apache-2.0
// Quantities of an element that are computed once from its coordinates without load.
//
// The parent cube is (xi, eta, zeta) in [-1, 1]^3, with nodes in the order of mesh.h and 2x2x2
// Gauss points of weight 1. Strain and stress at a Gauss point are expressed in the cylindrical
// axes of the spin axis at this point (radial, circumferential, axial; see materials.h).
#pragma once

#include <Eigen/Core>
#include <array>

#include "models/fe_tire/element/hex8.h"

namespace latsch::fe_tire {

inline constexpr double kGauss = 0.57735026918962576451;  // 1 / sqrt(3)
/// Signs of the nodes' parent coordinates. The Gauss points have the same order; their coordinates
/// are kGauss times these signs.
inline constexpr double kXi[8] = {-1, 1, 1, -1, -1, 1, 1, -1};
inline constexpr double kEta[8] = {-1, -1, 1, 1, -1, -1, 1, 1};
inline constexpr double kZeta[8] = {-1, -1, -1, -1, 1, 1, 1, 1};

using Vector8 = Eigen::Matrix<double, 8, 1>;

/// Strain operators of the solid-shell, with the symbols of hex8_solid_shell_kernel.h. Vectors with
/// one entry per node are expressed in the modal vectors h_m (hex8_solid_shell_modes.h): v = sum_m
/// v[m] h_m.
template <class Number>
struct SolidShellOperators {
  static constexpr int kModes = 7;
  static constexpr int kStrains = 18;  // generalized strains: E_c (6) and e (12)
  static constexpr int kEnhanced = 8;  // alpha
  static constexpr int kSquares = 7;   // number of hourglass squares, see solid_shell::kSquares
  static constexpr int kColumns = kStrains + kEnhanced;

  // 1/m, mean gradients of the shape functions in the axes of the element's center
  Number b[kModes][3];
  Number gamma[kModes][3];  // hourglass vectors: z_j = sum_m x_m gamma[m][j]
  /// Weights with which F a_j = sum_m x_m along[m][j]. The unit vectors a_j point along xi, across
  /// it, and normal to both.
  Number along[kModes][3];
  // 1/m^2, contributions to E_c of the squared components of z_m along the axes
  Number w[6][kSquares];
  // Strains at the points: E[point][r] = sum_j P[point][r][j] (E_c, e, alpha)_j.
  Number P[8][6][kColumns];
};

struct SolidShellShape : SolidShellOperators<double> {
  double e0[12];  // m^2, values of the products in e without load
  double volume;  // m^3
  double L2[2];   // m^2, |X_1|^2 and |X_2|^2
  /// Dyads (in the Voigt order of stresses) of the element's meridional axis 2 and normal axis 3,
  /// in the axes of its center.
  Vector6 d22, d33, d23, d13;
  double length, thickness;  // m, dimensions along eta and zeta
};

/// Map from the displacements of an element's corners to those of the straight prism in which an
/// arc is computed: (R.1) of hex8_shape.cpp.
struct ArcMap {
  bool is_arc = false;  // false: the element is a brick between chords, and the map is the identity
  // Complex factors, for x + i z, of the corner itself and of the corner at the other end of its
  // edge along xi, by end (0: xi = -1, 1: xi = +1) and part (real, imaginary).
  double own[2][2] = {{1.0, 0.0}, {1.0, 0.0}}, other[2][2] = {{0.0, 0.0}, {0.0, 0.0}};
  bool operator==(const ArcMap&) const = default;
};
/// Corners at both ends of the edges along xi, xi = -1 first.
inline constexpr int kArcEnds[4][2] = {{0, 1}, {3, 2}, {4, 5}, {7, 6}};

struct HexShape {
  ElementKind kind = ElementKind::full_integration;
  Matrix38 corners;  // m, coordinates in the frame of the sector
  /// m, coordinates in which strains are computed: those of the prism if `arc` says so, otherwise
  /// those of the corners.
  Matrix38 X;
  ArcMap arc;
  // Volume of each Gauss point, m^3; not positive if the element is inverted.
  std::array<double, 8> dV;
  double dN[8][3][8];  // 1/m, gradients [point][direction][node] in the axes of the point
  // Set only for the solid-shell. `rough` holds the same operators in single precision, for rough
  // tangents.
  SolidShellShape solid_shell;
  SolidShellOperators<float> rough;
};

/// Returns the values of the shape functions at a point of the parent cube.
Vector8 shape_functions(double xi, double eta, double zeta);
/// Returns the derivatives of the shape functions by xi, eta, zeta (one row each).
Matrix38 parent_gradients(double xi, double eta, double zeta);
/// Returns dX/dxi, dX/deta, dX/dzeta as columns. `is_arc`: X is the prism of an arc, in which the
/// sections xi = const count as parallel (hex8_shape.cpp).
Eigen::Matrix3d parent_jacobian(
    const Matrix38& X, double xi, double eta, double zeta, bool is_arc = false);
/// Returns the map (R.1) for displacements in the frame of the plane xi = -1, of a sector with the
/// angle 2 h between its section planes, rad. The axes of the result are those of the middle.
ArcMap arc_map(double h);

/// Returns the coordinates of the prism for corners with the coordinates X [3 x 8] in the frame of
/// the plane xi = -1. The units remain.
Matrix38 in_prism(const ArcMap& map, const Matrix38& X);
/// Returns the cylindrical axes at X as columns: radial, circumferential, axial. On the spin axis,
/// where they are undefined, returns those of the lowest point of a wheel.
Eigen::Matrix3d cylindrical_triad(const Eigen::Vector3d& X);

}  // namespace latsch::fe_tire
