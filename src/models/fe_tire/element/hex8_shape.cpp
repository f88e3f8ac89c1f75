// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/element/hex8_shape.h"

#include <Eigen/LU>
#include <cmath>

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
  shape.X = X;
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

}  // namespace latsch::fe_tire
