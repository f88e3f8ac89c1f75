// SPDX-License-Identifier: Apache-2.0
// Arcs: elements of a ring whose axisymmetric states do not depend on the width of the sectors.
//
// A brick between the two section planes of a sector has chords in place of arcs. Its volume, its
// meridional strain and the gas it encloses err by a share of order h^2, where 2 h is the angle
// between the planes. In a ring of unlike sectors these errors differ, and the inflated ring is not
// round. The default element is therefore computed in a straight prism. In section planes,
// positions are complex numbers Z = R + i V (R: radius, V: along the circumference), which a turn
// by the angle theta multiplies by exp(i theta). With the positions Z+ and Z- of the two ends of an
// edge along xi, in the axes of the middle between the planes,
//
//   m = (Z+ + Z-) / 2,   d = (Z+ - Z-) / 2
//   M = A m - i B d,   D = (h / sin h) d,   A = sin h / h,   B = 1 / sin h - cos h / h        (R.1)
//
// and the prism has the ends M +- D; positions along the spin axis remain. For an axisymmetric
// state, Z+- = Z exp(+-i h), this gives
//
//   M = Z,   D = i h Z                                                                        (R.2)
//
// Lengths along xi are then those of the arc, and sections have their true shape. The map is linear
// and the same for positions and displacements, so forces and stiffness follow by its transpose.
//   B follows from A by (R.2). A is chosen so that the force F that a sector transmits through a
// section plane does not depend on h either. With the hoop force T and the radial force g that all
// other stresses and the gas exert on the nodes of one plane, by the transposed map,
//
//   F = T h cot h + g (A sin h - B cos h),   g = h T in equilibrium                           (R.3)
//
// and F = T requires A = sin h / h. This is the mean of exp(i theta) over the arc, the share with
// which a translation of the sector counts as radial motion. The forces of a translated ring
// therefore have no resultant, whatever the widths are.
//   Rigid translations of a sector, its turns about the spin axis and about its own radius cause no
// strain. A turn by beta about its tangent is strained by at most beta h^2 / 6, because (R.1) takes
// a part of it for the turn of an axisymmetric section. All these errors are of second order, as
// those of the brick.
//   In the prism the sections xi = const count as parallel: Jacobians, axes of materials and
// directions of cords are those of xi = 0 (parent_jacobian). A strain that is constant in
// cylindrical axes does not vary along xi there, so the rows of H for variations along xi vanish.
//   The gas needs walls between the prism and the center of the wheel (pressure_kernel.h), since
// prisms of neighbors do not meet. With them it has a potential in every element.
#include "models/fe_tire/element/hex8_shape.h"

#include <Eigen/LU>
#include <cmath>
#include <complex>

#include "models/fe_tire/element/hex8_solid_shell.h"

namespace latsch::fe_tire {

Vector8 shape_functions(double xi, double eta, double zeta) {
  Vector8 N;
  for (int a = 0; a < 8; ++a) {
    N[a] = 0.125 * (1.0 + kXi[a] * xi) * (1.0 + kEta[a] * eta) * (1.0 + kZeta[a] * zeta);
  }
  return N;
}

Matrix38 parent_gradients(double xi, double eta, double zeta) {
  Matrix38 dN;
  for (int a = 0; a < 8; ++a) {
    const double A = 1.0 + kXi[a] * xi, B = 1.0 + kEta[a] * eta, C = 1.0 + kZeta[a] * zeta;
    dN.col(a) << 0.125 * kXi[a] * B * C, 0.125 * A * kEta[a] * C, 0.125 * A * B * kZeta[a];
  }
  return dN;
}

Eigen::Matrix3d parent_jacobian(
    const Matrix38& X, double xi, double eta, double zeta, bool is_arc) {
  Eigen::Matrix3d J = X * parent_gradients(xi, eta, zeta).transpose();
  if (is_arc) J.rightCols<2>() = X * parent_gradients(0.0, eta, zeta).transpose().rightCols<2>();
  return J;
}

Eigen::Matrix3d cylindrical_triad(const Eigen::Vector3d& X) {
  const double r = std::hypot(X[0], X[2]);
  const double sine = r > 0.0 ? X[0] / r : 0.0, cosine = r > 0.0 ? -X[2] / r : 1.0;
  Eigen::Matrix3d R;
  R.col(0) << sine, 0.0, -cosine;
  R.col(1) << cosine, 0.0, sine;
  R.col(2) << 0.0, -1.0, 0.0;
  return R;
}

HexShape make_shape(ElementKind kind, const Matrix38& X, double wall) {
  HexShape shape;
  shape.kind = kind;
  shape.corners = shape.X = X;
  for (int q = 0; q < 8; ++q) {
    const double xi = kGauss * kXi[q], eta = kGauss * kEta[q], zeta = kGauss * kZeta[q];
    const Matrix38 parent = parent_gradients(xi, eta, zeta);
    const Eigen::Matrix3d J = X * parent.transpose();  // columns: dX/dxi, dX/deta, dX/dzeta
    const Eigen::Matrix3d R = cylindrical_triad(X * shape_functions(xi, eta, zeta));
    shape.dV[q] = J.determinant();
    const Matrix38 dN = (J.inverse() * R).transpose() * parent;
    for (int i = 0; i < 3; ++i) {
      for (int a = 0; a < 8; ++a) shape.dN[q][i][a] = dN(i, a);
    }
  }
  if (kind == ElementKind::solid_shell) {
    shape.solid_shell = make_solid_shell_shape(X, wall);
    shape.rough = rounded(shape.solid_shell);
  }
  return shape;
}

using Complex = std::complex<double>;

ArcMap arc_map(double h) {
  // M + D = own Z+ + other Z-, and M - D follows by conjugation.
  const double s = std::sin(h), c = std::cos(h);
  const double A = s / h, B = 1.0 / s - c / h, D = h / s;
  const Complex to_middle = std::polar(1.0, -h);
  const Complex own = 0.5 * Complex(A + D, -B), other = 0.5 * Complex(A - D, B);
  const Complex first_own = std::conj(own) * to_middle, first_other = std::conj(other) * to_middle;
  const Complex next_own = own * to_middle, next_other = other * to_middle;
  return {true,
          {{first_own.real(), first_own.imag()}, {next_own.real(), next_own.imag()}},
          {{first_other.real(), first_other.imag()}, {next_other.real(), next_other.imag()}}};
}

Matrix38 in_prism(const ArcMap& map, const Matrix38& X) {
  Matrix38 prism = X;
  for (const auto& pair : kArcEnds) {
    const Complex ends[2] = {{X(0, pair[0]), X(2, pair[0])}, {X(0, pair[1]), X(2, pair[1])}};
    for (int k = 0; k < 2; ++k) {
      const Complex w = Complex(map.own[k][0], map.own[k][1]) * ends[k] +
                        Complex(map.other[k][0], map.other[k][1]) * ends[1 - k];
      prism(0, pair[k]) = w.real();
      prism(2, pair[k]) = w.imag();
    }
  }
  return prism;
}

HexShape make_arc_shape(const Matrix38& X, double h, double wall) {
  const ArcMap map = arc_map(h);
  HexShape shape = make_shape(ElementKind::solid_shell, in_prism(map, X), wall);
  shape.corners = X;
  shape.arc = map;
  shape.solid_shell = make_solid_shell_shape(shape.X, wall, true);
  shape.rough = rounded(shape.solid_shell);
  for (int q = 0; q < 8; ++q) {
    shape.dV[q] =
        parent_jacobian(shape.X, kGauss * kXi[q], kGauss * kEta[q], kGauss * kZeta[q], true)
            .determinant();
  }
  return shape;
}

}  // namespace latsch::fe_tire
