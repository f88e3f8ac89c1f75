// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/history/point_strains.h"

#include "models/fe_tire/element/hex8_batch.h"
#include "models/fe_tire/element/hex8_solid_shell_modes.h"

namespace latsch::fe_tire {
namespace {

using Modal = Eigen::Matrix<double, 3, SolidShellShape::kModes>;
using solid_shell::k1, solid_shell::k12, solid_shell::k123, solid_shell::k13, solid_shell::k2,
    solid_shell::k23;

/// Moves tied corners to their places on the line between two nodes.
void place_tied_corners(const EdgeTie& tie, Matrix38& u) {
  if (tie.eta == 0) return;
  for (const auto& [lower, upper] : tie.pairs()) {
    const Eigen::Vector3d from = u.col(lower), way = u.col(upper) - u.col(lower);
    u.col(lower) = from + tie.lower * way;
    u.col(upper) = from + tie.upper * way;
  }
}

/// Returns (E_c, e) of the solid-shell, (2) and (3) of hex8_solid_shell_kernel.h.
Eigen::Matrix<double, SolidShellShape::kStrains, 1> generalized_strains(const SolidShellShape& s,
                                                                        const Modal& x) {
  Eigen::Matrix3d F = Eigen::Matrix3d::Zero(), z = F, d = F;
  for (int m = 0; m < SolidShellShape::kModes; ++m) {
    for (int j = 0; j < 3; ++j) {
      F.col(j) += s.b[m][j] * x.col(m);
      z.col(j) += s.gamma[m][j] * x.col(m);
      d.col(j) += s.along[m][j] * x.col(m);
    }
  }
  Eigen::Matrix<double, SolidShellShape::kStrains, 1> g;
  for (int r = 0; r < 6; ++r) {
    const double C = F.col(voigt::kRow[r]).dot(F.col(voigt::kColumn[r]));
    g[r] = r < 3 ? 0.5 * (C - 1.0) : C;
  }
  for (int q = 0; q < SolidShellShape::kSquares; ++q) {
    const auto& [of, axis] = solid_shell::kSquares[q];
    const double c = z.col(of).dot(d.col(axis));
    for (int r = 0; r < 6; ++r) g[r] += s.w[r][q] * c * c;
  }
  for (int e = 0; e < 12; ++e) g[6 + e] = -s.e0[e];
  for (const auto& [e, m, n] : solid_shell::kPairs) g[6 + e] += x.col(m).dot(x.col(n));
  return g;
}

void set_solid_shell(const SolidShellShape& s,
                     const Modal& modal,
                     const double* alpha,
                     PointStrains& strains) {
  Eigen::Matrix<double, SolidShellShape::kColumns, 1> all;
  all.head<SolidShellShape::kStrains>() = generalized_strains(s, modal);
  for (int j = 0; j < SolidShellShape::kEnhanced; ++j)
    all[SolidShellShape::kStrains + j] = alpha[j];
  using Rows = Eigen::Matrix<double, 6, SolidShellShape::kColumns, Eigen::RowMajor>;
  for (int q = 0; q < 8; ++q) strains.E.col(q) = Eigen::Map<const Rows>(&s.P[q][0][0]) * all;
}

void set_full_integration(const HexShape& shape, const Matrix38& x, PointStrains& strains) {
  using Rows = Eigen::Matrix<double, 3, 8, Eigen::RowMajor>;
  for (int q = 0; q < 8; ++q) {
    const Eigen::Matrix3d F = x * Eigen::Map<const Rows>(&shape.dN[q][0][0]).transpose();
    const Eigen::Matrix3d C = F.transpose() * F;
    for (int r = 0; r < 6; ++r) {
      const double c = C(voigt::kRow[r], voigt::kColumn[r]);
      strains.E(r, q) = r < 3 ? 0.5 * (c - 1.0) : c;
    }
  }
}

/// Returns the strains of a cord layer by the displacements and the enhanced strains.
Eigen::Vector4d cord_strains(const CordSheet& sheet, const Modal& x, const double* alpha) {
  Eigen::Matrix3d y;
  y.col(0) = x.col(k1) + sheet.zeta * x.col(k13);
  y.col(1) = x.col(k2) + sheet.zeta * x.col(k23);
  y.col(2) = x.col(k12) + sheet.zeta * x.col(k123);
  const Eigen::Matrix3d yy = y.transpose() * y;
  Eigen::Vector4d e;
  for (int q = 0; q < 4; ++q) {
    const CordSheet::Point& point = sheet.points[q];
    double square = 0.0;
    for (int m = 0; m < 3; ++m) {
      for (int n = 0; n < 3; ++n) square += point.W[m][n] * yy(m, n);
    }
    e[q] = 0.5 * (square - 1.0);
    if (alpha != nullptr) e[q] += point.p[0] * alpha[0] + point.p[1] * alpha[1];
  }
  return e;
}

}  // namespace

PointStrains point_strains(const ElementLaw& law, Matrix38 u, const double* alpha) {
  const HexShape& shape = *law.shape;
  place_tied_corners(law.tie, u);
  const Matrix38 x = shape.X + in_prism(shape.arc, u);
  const Modal modal = x * solid_shell::modal_matrix().transpose();
  const bool is_shell = shape.kind == ElementKind::solid_shell;
  PointStrains strains;
  if (is_shell)
    set_solid_shell(shape.solid_shell, modal, alpha, strains);
  else
    set_full_integration(shape, x, strains);
  for (const CordSheet& sheet : law.cords)
    strains.cords.push_back(cord_strains(sheet, modal, is_shell ? alpha : nullptr));
  return strains;
}

Vector6 isochoric_stress(const Hyperelastic& law, const Vector6& E) {
  const Hyperelastic without_bulk{law.C10, law.C01, 0.0};
  Vector6 S;
  double D[6][6];
  rubber_stress(without_bulk, E.data(), S.data(), D);
  return S;
}

Vector6 isochoric_stress(double G, const Vector6& E) {
  Vector6 S = G * E;
  S.head<3>() = 2.0 * G * (E.head<3>().array() - E.head<3>().mean());
  return S;
}

}  // namespace latsch::fe_tire
