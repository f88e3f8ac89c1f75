// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/element/hyperelastic.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "models/fe_tire/element/hex8_batch.h"

namespace latsch::fe_tire {
namespace {

using voigt::kColumn, voigt::kRow;

Eigen::Matrix3d right_cauchy_green(const Vector6& E) {
  Eigen::Matrix3d C = Eigen::Matrix3d::Identity();
  for (int k = 0; k < 6; ++k) {
    C(kRow[k], kColumn[k]) += k < 3 ? 2.0 * E[k] : E[k];
    C(kColumn[k], kRow[k]) = C(kRow[k], kColumn[k]);
  }
  return C;
}

}  // namespace

Hyperelastic Hyperelastic::from_young_modulus(double E, double nu, double ratio) {
  const double G = E / (2.0 * (1.0 + nu));
  const double C10 = G / (2.0 * (1.0 + ratio));
  return {.C10 = C10, .C01 = ratio * C10, .K = E / (3.0 * (1.0 - 2.0 * nu))};
}

StVenantKirchhoff StVenantKirchhoff::isotropic(double G, double lambda) {
  StVenantKirchhoff law;
  law.D.topLeftCorner<3, 3>().setConstant(lambda);
  law.D.diagonal().head<3>().array() += 2.0 * G;
  law.D.diagonal().tail<3>().setConstant(G);
  return law;
}

bool stress(const Hyperelastic& law, const Vector6& E, Vector6& S, Matrix6* D) {
  double tangent[6][6];
  if (!(rubber_stress(law, E.data(), S.data(), tangent) > 0.0)) return false;
  if (D != nullptr) *D = Matrix6::Map(&tangent[0][0]);
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
