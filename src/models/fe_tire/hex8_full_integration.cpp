// SPDX-License-Identifier: Apache-2.0
// Eight-node displacement element with 2x2x2 Gauss points, total Lagrangian (CalculiX' C3D8):
//   F = x dN^T,  E = (F^T F - 1) / 2
//   f = sum dV B^T S,  K = sum dV (B^T D B + dN^T S dN (x) 1)
// For comparison: it locks in shear, in thickness bending and for nearly incompressible rubber.
// [Bathe 1996] Finite Element Procedures, section 6.3.5.
#include "models/fe_tire/hex8_full_integration.h"

namespace latsch::fe_tire {
namespace {

constexpr int kRow[6] = {0, 1, 2, 0, 1, 0};
constexpr int kColumn[6] = {0, 1, 2, 1, 2, 2};

/// F at the eight points, F[i][k][point]; false where det F is not positive.
LATSCH_INLINE bool deformation_gradient(const HexShape& shape, const Lanes* x, Lanes (*F)[3]) {
  bool upright = true;
  for (int q = 0; q < 8; ++q) {
    double f[3][3];
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) F[i][k][q] = f[i][k] = sum(x[i] * shape.dN[q][k]);
    }
    const double det = f[0][0] * (f[1][1] * f[2][2] - f[1][2] * f[2][1]) +
                       f[0][1] * (f[1][2] * f[2][0] - f[1][0] * f[2][2]) +
                       f[0][2] * (f[1][0] * f[2][1] - f[1][1] * f[2][0]);
    upright &= det > 0.0 && shape.dV[q] > 0.0;
  }
  return upright;
}

LATSCH_INLINE void green_lagrange(const Lanes (*F)[3], Lanes* E) {
  for (int k = 0; k < 6; ++k) {
    const int r = kRow[k], c = kColumn[k];
    const Lanes C = F[0][r] * F[0][c] + F[1][r] * F[1][c] + F[2][r] * F[2][c];
    E[k] = k < 3 ? 0.5 * (C - 1.0) : C;
  }
}

/// dE = B du at point q.
LATSCH_INLINE void strain_operator(const Lanes (*F)[3], const Lanes* dN, int q, Lanes (*B)[3]) {
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 6; ++k) {
      const int r = kRow[k], c = kColumn[k];
      B[k][i] = F[i][r][q] * dN[c];
      if (k >= 3) B[k][i] += F[i][c][q] * dN[r];
    }
  }
}

/// H += dN^T S dN
LATSCH_INLINE void add_stress_stiffness(const Lanes* dN, const double* S, Lanes* H) {
  const Lanes t[3] = {S[0] * dN[0] + S[3] * dN[1] + S[5] * dN[2],
                      S[3] * dN[0] + S[1] * dN[1] + S[4] * dN[2],
                      S[5] * dN[0] + S[4] * dN[1] + S[2] * dN[2]};
  for (int a = 0; a < 8; ++a) {
    H[a] += dN[0][a] * t[0] + dN[1][a] * t[1] + dN[2][a] * t[2];
  }
}

LATSCH_CLONES
bool add(
    const HexShape& shape, const PointLaw& law, const Lanes* x, bool stiffness, NodalSums& sums) {
  Lanes F[3][3], E[6], S[6], D[6][6];
  if (!deformation_gradient(shape, x, F)) return false;
  green_lagrange(F, E);
  if (!stress(law, E, lanes(shape.dV.data()), S, D)) return false;
  Lanes B[48][3], DB[48][3], H[8] = {};
  for (int q = 0; q < 8; ++q) {
    Lanes(*Bq)[3] = B + 6 * q;
    strain_operator(F, shape.dN[q].data(), q, Bq);
    for (int k = 0; k < 6; ++k) {
      for (int i = 0; i < 3; ++i) sums.f[i] += S[k][q] * Bq[k][i];
    }
    if (!stiffness) continue;
    for (int k = 0; k < 6; ++k) {
      for (int i = 0; i < 3; ++i) {
        Lanes row = {};
        for (int l = 0; l < 6; ++l) row += D[k][l][q] * Bq[l][i];
        DB[6 * q + k][i] = row;
      }
    }
    const double Sq[6] = {S[0][q], S[1][q], S[2][q], S[3][q], S[4][q], S[5][q]};
    add_stress_stiffness(shape.dN[q].data(), Sq, H);
  }
  if (!stiffness) return true;
  add_product<48>(B, DB, sums);
  add_geometric(H, sums);
  return true;
}

}  // namespace

bool add_full_integration(const HexShape& shape,
                          const PointLaw& law,
                          const Matrix38& x,
                          bool stiffness,
                          NodalSums& sums) {
  Lanes by_direction[3];
  for (int i = 0; i < 3; ++i) {
    for (int a = 0; a < 8; ++a) by_direction[i][a] = x(i, a);
  }
  return add(shape, law, by_direction, stiffness, sums);
}

}  // namespace latsch::fe_tire
