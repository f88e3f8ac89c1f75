// SPDX-License-Identifier: Apache-2.0
// Mooney-Rivlin rubber with a volumetric penalty, decoupled into isochoric and volumetric parts:
//   W = C10 (J^(-2/3) I1 - 3) + C01 (J^(-4/3) I2 - 3) + K/2 (J - 1)^2,    I2 = (I1^2 - C:C) / 2
//   S = 2 dW/dC,  D = 4 d2W/dC2
// from dI1/dC = I, dI2/dC = I1 I - C, dJ/dC = J C^-1 / 2, dC^-1/dC = -C^-1 (.) C^-1.
// Holds for moderate strain (rubber below about 100 %); no Mullins effect, no viscosity.
// [Holzapfel 2000] Nonlinear Solid Mechanics, sections 6.4-6.6.
#include "models/fe_tire/hyperelastic.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>

namespace latsch::fe_tire {
namespace {

constexpr int kRow[6] = {0, 1, 2, 0, 1, 0};
constexpr int kColumn[6] = {0, 1, 2, 1, 2, 2};

Eigen::Matrix3d right_cauchy_green(const Vector6& E) {
  Eigen::Matrix3d C = Eigen::Matrix3d::Identity();
  for (int k = 0; k < 6; ++k) {
    C(kRow[k], kColumn[k]) += k < 3 ? 2.0 * E[k] : E[k];
    C(kColumn[k], kRow[k]) = C(kRow[k], kColumn[k]);
  }
  return C;
}

Vector6 voigt(const Eigen::Matrix3d& A) {
  Vector6 v;
  for (int k = 0; k < 6; ++k) v[k] = A(kRow[k], kColumn[k]);
  return v;
}

/// (A (.) A)_ijkl = (A_ik A_jl + A_il A_jk) / 2
Matrix6 symmetric_product(const Eigen::Matrix3d& A) {
  Matrix6 P;
  for (int a = 0; a < 6; ++a) {
    for (int b = 0; b < 6; ++b) {
      const int i = kRow[a], j = kColumn[a], k = kRow[b], l = kColumn[b];
      P(a, b) = 0.5 * (A(i, k) * A(j, l) + A(i, l) * A(j, k));
    }
  }
  return P;
}

}  // namespace

Hyperelastic Hyperelastic::from_young_modulus(double E, double nu, double ratio) {
  const double G = E / (2.0 * (1.0 + nu));
  const double C10 = G / (2.0 * (1.0 + ratio));
  return {.C10 = C10, .C01 = ratio * C10, .K = E / (3.0 * (1.0 - 2.0 * nu))};
}

bool stress(const Hyperelastic& law, const Vector6& E, Vector6& S, Matrix6* D) {
  const Eigen::Matrix3d C_ = right_cauchy_green(E);
  const double det = C_.determinant();
  if (!(det > 0.0)) return false;
  const Eigen::Matrix3d C_inverse = C_.inverse();
  const Vector6 I = voigt(Eigen::Matrix3d::Identity()), C = voigt(C_), Ci = voigt(C_inverse);
  const double J = std::sqrt(det);
  const double j = 1.0 / std::cbrt(det);  // J^(-2/3)
  const double I1 = C_.trace();
  const double I2 = 0.5 * (I1 * I1 - C_.squaredNorm());
  const double a = 2.0 * law.C10 * j, b = 2.0 * law.C01 * j * j;
  const double p = law.K * (J - 1.0);
  const Vector6 B = I1 * I - C;  // dI2/dC
  S = a * (I - I1 / 3.0 * Ci) + b * (B - 2.0 / 3.0 * I2 * Ci) + p * J * Ci;
  if (D == nullptr) return true;
  const Vector6 A = -2.0 / 3.0 * (a * I + 2.0 * b * B);
  const double cc = 2.0 / 9.0 * (a * I1 + 4.0 * b * I2) + law.K * (2.0 * J - 1.0) * J;
  const double ci = 2.0 / 3.0 * (a * I1 + 2.0 * b * I2) - 2.0 * p * J;
  D->noalias() = A * Ci.transpose() + Ci * A.transpose() + cc * Ci * Ci.transpose();
  *D += ci * symmetric_product(C_inverse);
  D->topLeftCorner<3, 3>().array() += 2.0 * b;  // I x I
  D->diagonal() -= 2.0 * b * (Vector6() << 1, 1, 1, 0.5, 0.5, 0.5).finished();
  return true;
}

bool stress(const StVenantKirchhoff& law, const Vector6& E, Vector6& S, Matrix6* D) {
  S.noalias() = law.D * E;
  if (D != nullptr) *D = law.D;
  return right_cauchy_green(E).determinant() > 0.0;
}

double energy(const Hyperelastic& law, const Vector6& E) {
  const Eigen::Matrix3d C = right_cauchy_green(E);
  const double det = C.determinant();
  if (!(det > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  const double J = std::sqrt(det), j = 1.0 / std::cbrt(det), I1 = C.trace();
  const double I2 = 0.5 * (I1 * I1 - C.squaredNorm());
  return law.C10 * (j * I1 - 3.0) + law.C01 * (j * j * I2 - 3.0) +
         0.5 * law.K * (J - 1.0) * (J - 1.0);
}

double energy(const StVenantKirchhoff& law, const Vector6& E) { return 0.5 * E.dot(law.D * E); }

}  // namespace latsch::fe_tire
