// SPDX-License-Identifier: Apache-2.0
// Eight-node displacement element with 2x2x2 Gauss points, total Lagrangian (CalculiX' C3D8):
//   F = 1 + u dN^T,  E = (F^T F - 1) / 2,  f = sum dV B^T S,  K = sum dV (B^T D B + dN^T S dN (x)
//   1)
// For comparison: it locks in shear, in thickness bending and for nearly incompressible rubber.
// [Bathe 1996] Finite Element Procedures, section 6.3.5.
#include "models/fe_tire/hex8_full_integration.h"

#include <Eigen/LU>

#include "models/fe_tire/hyperelastic.h"

namespace latsch::fe_tire {
namespace {

using Matrix6x24 = Eigen::Matrix<double, 6, 24>;

Vector6 green_lagrange(const Eigen::Matrix3d& F) {
  const Eigen::Matrix3d C = F.transpose() * F;
  Vector6 E;
  E << 0.5 * (C(0, 0) - 1.0), 0.5 * (C(1, 1) - 1.0), 0.5 * (C(2, 2) - 1.0), C(0, 1), C(1, 2),
      C(0, 2);
  return E;
}

/// dE = B du; F's columns are the derivatives along the axes of the strain.
Matrix6x24 strain_operator(const Eigen::Matrix3d& F, const Matrix38& dN) {
  Matrix6x24 B;
  for (int a = 0; a < 8; ++a) {
    for (int i = 0; i < 3; ++i) {
      B.col(3 * a + i) << F(i, 0) * dN(0, a), F(i, 1) * dN(1, a), F(i, 2) * dN(2, a),
          F(i, 0) * dN(1, a) + F(i, 1) * dN(0, a), F(i, 1) * dN(2, a) + F(i, 2) * dN(1, a),
          F(i, 0) * dN(2, a) + F(i, 2) * dN(0, a);
    }
  }
  return B;
}

Eigen::Matrix3d tensor(const Vector6& S) {
  Eigen::Matrix3d T;
  T << S[0], S[3], S[5], S[3], S[1], S[4], S[5], S[4], S[2];
  return T;
}

}  // namespace

bool add_full_integration(
    const HexShape& shape, const Solid& solid, const Matrix38& u, Vector24& f, Matrix24* K) {
  const Matrix38 x = shape.X + u;
  for (int q = 0; q < 8; ++q) {
    const Matrix38& dN = shape.dN[q];
    const double dV = shape.dV[q];
    const Eigen::Matrix3d F = x * dN.transpose();
    Vector6 S;
    Matrix6 D;
    const auto law = [&](const auto& l) {
      return stress(l, green_lagrange(F), S, K != nullptr ? &D : nullptr);
    };
    if (!(F.determinant() * dV > 0.0) || !std::visit(law, solid.law)) return false;
    const Matrix6x24 B = strain_operator(F, dN);
    f.noalias() += dV * B.transpose() * S;
    if (K == nullptr) continue;
    const Matrix6x24 DB = dV * D * B;
    K->noalias() += B.transpose() * DB;
    const Matrix8 H = dV * dN.transpose() * tensor(S) * dN;
    for (int a = 0; a < 8; ++a) {
      for (int b = 0; b < 8; ++b) {
        for (int i = 0; i < 3; ++i) (*K)(3 * a + i, 3 * b + i) += H(a, b);
      }
    }
  }
  return true;
}

}  // namespace latsch::fe_tire
