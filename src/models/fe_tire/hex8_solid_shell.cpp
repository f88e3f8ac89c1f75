// SPDX-License-Identifier: Apache-2.0
// Eight-node solid-shell for walls of few, thin, very different layers of nearly incompressible
// rubber and cords. Total Lagrangian; all laws see the Green-Lagrange strain
//
//   E = E_c + (A - <A>) (e - H E_c) + (A - <A>) alpha            <.>: mean over the volume      (1)
//   E_c = (F^T F - 1) / 2 + w c c,   F = sum_a x_a b_a^T,  b_a = <grad N_a>                     (2)
//   e = x_m . x_n - X_m . X_n,  x = x_0 + x_1 xi + x_2 eta + ... + x_123 xi eta zeta            (3)
//   z_m = x_m - F X_m,  c_mj = z_m . F a_j,  a_j: unit vectors along xi, across it, normal (4)
//
// E_c is the strain of the mean deformation gradient; e are the twelve coefficients of the
// convected strains in xi, eta, zeta that bending, twisting and tapering need
// (hex8_solid_shell_modes.h), H E_c their values in a constant strain E_c, and A turns convected
// strain at a point into Cartesian strain. What is left out is what locks: shear that varies along
// its own direction (2 E_13 along xi, as in the assumed strains of Dvorkin and Bathe), in-plane
// shear along xi and eta, and the thickness strain of a curved element's middle. Six and twelve
// strains hold the 24 - 6 deformations exactly once: there is no hourglass mode and no hourglass
// stiffness.
//   Twelve modes with values and slopes zero in a constant strain and <A - <A>> = 0 pass every
// patch test on any shape [Simo & Hughes 1986]; curved walls then stretch their nodes' thickness a
// little instead of locking. The mean of the quadratic terms, w c c, is second order there too; it
// keeps the tension of an inflated wall acting on the hourglass shapes. A square of c belongs into
// E_11 or E_22 exactly where the strain that is linear in that c is kept: z_12 along xi (E_11),
// across it (E_22) and along the normal (twist, both); z_13 along xi and across it (E_11), z_23
// likewise (E_22). Where a shear is left out, leaning edges count as turned without strain, and
// their square alone would dilate the element: pressure would then buckle long elements in turn,
// from a pressure of the order of G (b/L)^2 on. For the same reason the thickness strain has none.
//   alpha: E_11 along xi, E_22 along eta, E_33 along zeta, xi zeta and eta zeta (Poisson's
// contraction in bending, in plane and through the thickness) and E_33 along xi, eta, xi eta.
// Without the last three an element of fixed volume would tie the thickness of neighboring nodes to
// its own in-plane strain. They are stiffened by the shear modulus, or nodes could move in and out
// in turn.
//   alpha solves sum dV P_alpha^T S = 0 by Newton's method, so f is the gradient and K the Hessian
// of the condensed energy.
//   [Simo & Rifai 1990, IJNME 29; Klinkel, Gruttmann & Wagner 1999, Comput. Struct. 71; Schwarze &
// Reese 2009, IJNME 80] for enhanced strain in E and for the Taylor expansion.
#include "models/fe_tire/hex8_solid_shell.h"

#include <algorithm>
#include <cmath>

#include "models/fe_tire/hex8_solid_shell_modes.h"

namespace latsch::fe_tire {
namespace solid_shell {

Eigen::Matrix<double, 7, 8> modal_matrix() {
  Eigen::Matrix<double, 7, 8> h;
  for (int a = 0; a < 8; ++a) {
    const double x = kXi[a], y = kEta[a], z = kZeta[a];
    h.col(a) << x, y, z, x * y, y * z, x * z, x * y * z;
  }
  return 0.125 * h;
}

}  // namespace solid_shell

namespace {

using solid_shell::kPairs;
using solid_shell::kSquares;

constexpr int kEnhanced = SolidShellShape::kEnhanced;
constexpr int kSquareCount = SolidShellShape::kSquares;
constexpr int kStrains = SolidShellShape::kStrains;
constexpr int kAlpha = 24;                // first column of alpha
constexpr double kInnerTolerance = 1e-9;  // strain; what is left of alpha enters f quadratically
constexpr int kInnerIterations = 15;

constexpr Lanes kModes[7] = {
    {-.125, .125, .125, -.125, -.125, .125, .125, -.125},
    {-.125, -.125, .125, .125, -.125, -.125, .125, .125},
    {-.125, -.125, -.125, -.125, .125, .125, .125, .125},
    {.125, -.125, .125, -.125, .125, -.125, .125, -.125},
    {.125, .125, -.125, -.125, -.125, -.125, .125, .125},
    {.125, -.125, -.125, .125, -.125, .125, .125, -.125},
    {-.125, .125, -.125, .125, .125, -.125, .125, -.125},
};

/// Where the element is: F, modal vectors x_m, hourglass vectors z_m (not z_123) and their c.
struct Kinematics {
  double F[3][3], x[7][3];
  double z[3][3], d[3][3], c[kSquareCount];  // equation (4); d_j = F a_j
};

LATSCH_INLINE double dot(const double* a, const double* b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

LATSCH_INLINE bool follow(const SolidShellShape& s, const Lanes* x, Kinematics& k) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) k.F[i][j] = sum(x[i] * s.b[j]);
    for (int m = 0; m < 7; ++m) k.x[m][i] = sum(x[i] * kModes[m]);
    for (int j = 0; j < 3; ++j) {
      k.z[j][i] = sum(x[i] * s.gamma[j]);
      k.d[j][i] = k.F[i][0] * s.axis[j][0] + k.F[i][1] * s.axis[j][1] + k.F[i][2] * s.axis[j][2];
    }
  }
  for (int q = 0; q < kSquareCount; ++q) k.c[q] = dot(k.z[kSquares[q].z], k.d[kSquares[q].axis]);
  const auto& F = k.F;
  return s.volume > 0.0 && F[0][0] * (F[1][1] * F[2][2] - F[1][2] * F[2][1]) +
                                   F[0][1] * (F[1][2] * F[2][0] - F[1][0] * F[2][2]) +
                                   F[0][2] * (F[1][0] * F[2][1] - F[1][1] * F[2][0]) >
                               0.0;
}

/// (E_c, e), equations (2) and (3).
LATSCH_INLINE void generalized_strains(const SolidShellShape& s, const Kinematics& k, double* g) {
  constexpr int kRow[6] = {0, 1, 2, 0, 1, 0}, kColumn[6] = {0, 1, 2, 1, 2, 2};
  for (int r = 0; r < 6; ++r) {
    const int i = kRow[r], j = kColumn[r];
    const double C = k.F[0][i] * k.F[0][j] + k.F[1][i] * k.F[1][j] + k.F[2][i] * k.F[2][j];
    g[r] = r < 3 ? 0.5 * (C - 1.0) : C;
  }
  for (int q = 0; q < kSquareCount; ++q) {
    const double square = k.c[q] * k.c[q];
    for (int r = 0; r < 6; ++r) g[r] += s.w[r][q] * square;
  }
  for (int e = 0; e < 12; ++e) g[6 + e] = -s.e0[e];
  for (const auto& [e, m, n] : kPairs) g[6 + e] += dot(k.x[m], k.x[n]);
}

/// d(F axis_j) = along[j] dx in every direction.
LATSCH_INLINE void along_axes(const SolidShellShape& s, Lanes* along) {
  for (int j = 0; j < 3; ++j) {
    along[j] = s.axis[j][0] * s.b[0] + s.axis[j][1] * s.b[1] + s.axis[j][2] * s.b[2];
  }
}

/// dc = Dc dx
LATSCH_INLINE void hourglass_operator(const SolidShellShape& s,
                                      const Kinematics& k,
                                      const Lanes* along,
                                      Lanes (*Dc)[3]) {
  for (int q = 0; q < kSquareCount; ++q) {
    const auto [m, j] = kSquares[q];
    for (int i = 0; i < 3; ++i) Dc[q][i] = k.d[j][i] * s.gamma[m] + k.z[m][i] * along[j];
  }
}

/// d(E_c, e) = B dx
LATSCH_INLINE void strain_operator(const SolidShellShape& s,
                                   const Kinematics& k,
                                   const Lanes (*Dc)[3],
                                   Lanes (*B)[3]) {
  for (int i = 0; i < 3; ++i) {
    const double* F = k.F[i];
    B[0][i] = F[0] * s.b[0];
    B[1][i] = F[1] * s.b[1];
    B[2][i] = F[2] * s.b[2];
    B[3][i] = F[0] * s.b[1] + F[1] * s.b[0];
    B[4][i] = F[1] * s.b[2] + F[2] * s.b[1];
    B[5][i] = F[0] * s.b[2] + F[2] * s.b[0];
    for (int q = 0; q < kSquareCount; ++q) {
      const Lanes dcc = 2.0 * k.c[q] * Dc[q][i];
      for (int r = 0; r < 6; ++r) B[r][i] += s.w[r][q] * dcc;
    }
    for (int e = 0; e < 12; ++e) B[6 + e][i] = Lanes{};
    for (const auto& [e, m, n] : kPairs) {
      B[6 + e][i] += k.x[m][i] * kModes[n] + k.x[n][i] * kModes[m];
    }
  }
}

/// Second derivative of the generalized strains times their stresses t.
LATSCH_INLINE void add_stress_stiffness(const SolidShellShape& s,
                                        const Kinematics& k,
                                        const Lanes* along,
                                        const Lanes (*Dc)[3],
                                        const double* t,
                                        NodalSums& sums) {
  const Lanes u[3] = {t[0] * s.b[0] + t[3] * s.b[1] + t[5] * s.b[2],
                      t[3] * s.b[0] + t[1] * s.b[1] + t[4] * s.b[2],
                      t[5] * s.b[0] + t[4] * s.b[1] + t[2] * s.b[2]};
  Lanes v[3] = {}, w[7] = {}, TDc[kSquareCount][3];
  for (int q = 0; q < kSquareCount; ++q) {
    double T = 0.0;
    for (int r = 0; r < 6; ++r) T += 2.0 * s.w[r][q] * t[r];
    v[kSquares[q].axis] += T * k.c[q] * s.gamma[kSquares[q].z];
    for (int i = 0; i < 3; ++i) TDc[q][i] = T * Dc[q][i];
  }
  add_product<kSquareCount>(Dc, TDc, sums);
  for (const auto& [e, m, n] : kPairs) {
    w[m] += t[6 + e] * kModes[n];
    w[n] += t[6 + e] * kModes[m];
  }
  Lanes H[8];
  for (int a = 0; a < 8; ++a) {
    H[a] = s.b[0][a] * u[0] + s.b[1][a] * u[1] + s.b[2][a] * u[2];
    for (int j = 0; j < 3; ++j) H[a] += v[j][a] * along[j] + along[j][a] * v[j];
    for (int m = 0; m < 7; ++m) H[a] += kModes[m][a] * w[m];
  }
  add_geometric(H, sums);
}

/// L D L^T of a symmetric 8x8 matrix in place (unit L below the diagonal); false where a pivot
/// vanishes. Negative ones occur far from equilibrium, under hydrostatic tension beyond G.
LATSCH_INLINE bool factorize(double (*A)[kEnhanced]) {
  for (int j = 0; j < kEnhanced; ++j) {
    const double diagonal = A[j][j];
    for (int k = 0; k < j; ++k) {
      const double l = A[j][k] * A[k][k];
      for (int i = j; i < kEnhanced; ++i) A[i][j] -= A[i][k] * l;
    }
    if (!(std::abs(A[j][j]) > 1e-9 * std::abs(diagonal))) return false;
    const double inverse = 1.0 / A[j][j];
    for (int i = j + 1; i < kEnhanced; ++i) A[i][j] *= inverse;
  }
  return true;
}

template <class Function>
LATSCH_INLINE void for_cords(Cords& cords, const Function& function) {
  for (int k = 0; k < cords.count; ++k) {
    for (CordPoint& point : cords.sheets[k].points) function(point);
  }
}

/// Stresses and tangents at the points (times dV) with alpha in equilibrium to first order.
struct Inner {
  Lanes S[6], D[6][6];
  double A[kEnhanced][kEnhanced];  // factors of the tangent of alpha
};

/// Newton's method for alpha. On return alpha is in equilibrium, `inner` its last linearization and
/// inner.S the stress extrapolated to that alpha.
LATSCH_INLINE bool solve_alpha(const HexShape& shape,
                               const PointLaw& law,
                               double relaxation,
                               const double* g,
                               Cords& cords,
                               double* alpha,
                               Inner& inner) {
  const SolidShellShape& s = shape.solid_shell;
  const Lanes dV = lanes(shape.dV.data());
  Lanes compatible[6] = {};
  for (int j = 0; j < kStrains; ++j) {
    for (int r = 0; r < 6; ++r) compatible[r] += g[j] * s.Pt[j][r];
  }
  double relaxed[kEnhanced] = {};
  for (int j = 5; j < kEnhanced; ++j) relaxed[j] = relaxation * s.volume / (j == 7 ? 9.0 : 3.0);
  for (int iteration = 0; iteration < kInnerIterations; ++iteration) {
    Lanes E[6];
    for (int r = 0; r < 6; ++r) {
      E[r] = compatible[r];
      for (int j = 0; j < kEnhanced; ++j) E[r] += alpha[j] * s.Pt[kAlpha + j][r];
    }
    if (!stress(law, E, dV, inner.S, inner.D)) return false;
    Lanes residual = {}, A[kEnhanced] = {};
    for (int q = 0; q < 8; ++q) {
      for (int r = 0; r < 6; ++r) {
        Lanes DP = {};
        for (int c = 0; c < 6; ++c) DP += inner.D[r][c][q] * s.P[8 * c + q][3];
        const Lanes P = s.P[8 * r + q][3];
        residual += inner.S[r][q] * P;
        for (int j = 0; j < kEnhanced; ++j) A[j] += P[j] * DP;
      }
    }
    double step[kEnhanced];
    for (int i = 0; i < kEnhanced; ++i) {
      for (int j = 0; j < kEnhanced; ++j) inner.A[i][j] = A[i][j];
      inner.A[i][i] += relaxed[i];
      step[i] = -residual[i] - relaxed[i] * alpha[i];
    }
    stretch(cords, alpha);
    for_cords(cords, [&](const CordPoint& cord) {
      for (int i = 0; i < 2; ++i) {
        step[i] -= cord.dV * cord.S * cord.p[i];
        for (int j = 0; j < 2; ++j) inner.A[i][j] += cord.dV * cord.tangent * cord.p[i] * cord.p[j];
      }
    });
    if (!factorize(inner.A)) return false;
    for (int i = 1; i < kEnhanced; ++i) {
      for (int j = 0; j < i; ++j) step[i] -= inner.A[i][j] * step[j];
    }
    for (int i = 0; i < kEnhanced; ++i) step[i] /= inner.A[i][i];
    for (int i = kEnhanced - 2; i >= 0; --i) {
      for (int j = i + 1; j < kEnhanced; ++j) step[i] -= inner.A[j][i] * step[j];
    }
    double largest = 0.0;
    for (int j = 0; j < kEnhanced; ++j) {
      alpha[j] += step[j];
      largest = std::max(largest, std::abs(step[j]));
    }
    const bool linear = law.rubber == nullptr && cords.count == 0;
    if (!linear && !(largest < kInnerTolerance)) continue;
    for (int r = 0; r < 6; ++r) {
      Lanes dE = {};
      for (int j = 0; j < kEnhanced; ++j) dE += step[j] * s.Pt[kAlpha + j][r];
      for (int c = 0; c < 6; ++c) inner.S[c] += inner.D[c][r] * dE;
    }
    for_cords(cords, [&](CordPoint& cord) {
      cord.S += cord.tangent * (cord.p[0] * step[0] + cord.p[1] * step[1]);
    });
    return true;
  }
  return false;
}

/// Tangents of the generalized strains, D, and between alpha and them, Da.
LATSCH_INLINE void tangents(const SolidShellShape& s,
                            const Inner& inner,
                            Lanes (*D)[3],
                            Lanes (*Da)[3]) {
  Lanes DP[48][3];
  for (int q = 0; q < 8; ++q) {
    for (int r = 0; r < 6; ++r) {
      Lanes row[3] = {};
      for (int c = 0; c < 6; ++c) {
        const Lanes d = all(inner.D[r][c][q]);
        for (int k = 0; k < 3; ++k) row[k] += d * s.P[8 * c + q][k];
      }
      for (int k = 0; k < 3; ++k) DP[8 * r + q][k] = row[k];
    }
  }
  for (int i = 0; i < kStrains + kEnhanced; ++i) {
    const int column = i < kStrains ? i : kAlpha + i - kStrains;
    Lanes row[3] = {};
    for (int p = 0; p < 48; ++p) {
      const Lanes b = all(s.P[p][column / 8][column % 8]);
      for (int k = 0; k < 3; ++k) row[k] += b * DP[p][k];
    }
    for (int k = 0; k < 3; ++k) (i < kStrains ? D[i] : Da[i - kStrains])[k] = row[k];
  }
}

/// rows x B, `rows` being tangents of generalized strains.
template <int count>
LATSCH_INLINE void times_B(const Lanes (*rows)[3], const Lanes (*B)[3], Lanes (*product)[3]) {
  for (int r = 0; r < count; ++r) {
    for (int i = 0; i < 3; ++i) product[r][i] = Lanes{};
    for (int c = 0; c < kStrains; ++c) {
      const Lanes d = all(rows[r][c / 8][c % 8]);
      for (int i = 0; i < 3; ++i) product[r][i] += d * B[c][i];
    }
  }
}

/// K -= K_a^T A^-1 K_a
LATSCH_INLINE void condense(const Inner& inner, Lanes (*Ka)[3], NodalSums& sums) {
  Lanes scaled[kEnhanced][3];
  for (int i = 0; i < kEnhanced; ++i) {  // L^-1 K_a
    const double inverse = -1.0 / inner.A[i][i];
    for (int c = 0; c < 3; ++c) {
      for (int j = 0; j < i; ++j) Ka[i][c] -= inner.A[i][j] * Ka[j][c];
      scaled[i][c] = inverse * Ka[i][c];
    }
  }
  add_product<kEnhanced>(Ka, scaled, sums);
}

LATSCH_CLONES
bool add(const HexShape& shape,
         const PointLaw& law,
         double relaxation,
         const Lanes* x,
         Cords& cords,
         double* alpha,
         bool stiffness,
         NodalSums& sums) {
  const SolidShellShape& s = shape.solid_shell;
  Kinematics k;
  if (!follow(s, x, k)) return false;
  double g[kStrains];
  generalized_strains(s, k, g);
  Inner inner;
  if (!solve_alpha(shape, law, relaxation, g, cords, alpha, inner)) return false;

  Lanes t[3] = {};
  for (int r = 0; r < 6; ++r) {
    for (int q = 0; q < 8; ++q) {
      for (int c = 0; c < 3; ++c) t[c] += inner.S[r][q] * s.P[8 * r + q][c];
    }
  }
  double stresses[24];
  std::memcpy(stresses, t, sizeof stresses);
  Lanes along[3], Dc[kSquareCount][3], B[kStrains][3];
  along_axes(s, along);
  hourglass_operator(s, k, along, Dc);
  strain_operator(s, k, Dc, B);
  for (int r = 0; r < kStrains; ++r) {
    for (int i = 0; i < 3; ++i) sums.f[i] += stresses[r] * B[r][i];
  }
  if (!stiffness) {
    add_cords(cords, false, sums, nullptr);
    return true;
  }
  Lanes D[kStrains][3], DB[kStrains][3], Da[kEnhanced][3], Ka[kEnhanced][3];
  tangents(s, inner, D, Da);
  times_B<kStrains>(D, B, DB);
  times_B<kEnhanced>(Da, B, Ka);
  add_cords(cords, true, sums, Ka);
  add_product<kStrains>(B, DB, sums);
  condense(inner, Ka, sums);
  add_stress_stiffness(s, k, along, Dc, stresses, sums);
  return true;
}

}  // namespace

bool add_solid_shell(const HexShape& shape,
                     const PointLaw& law,
                     double relaxation,
                     const Matrix38& x,
                     Cords& cords,
                     double* alpha,
                     bool stiffness,
                     NodalSums& sums) {
  Lanes by_direction[3];
  for (int i = 0; i < 3; ++i) {
    for (int a = 0; a < 8; ++a) by_direction[i][a] = x(i, a);
  }
  double start[kEnhanced];
  std::copy_n(alpha, kEnhanced, start);
  if (add(shape, law, relaxation, by_direction, cords, alpha, stiffness, sums)) return true;
  std::fill_n(alpha, kEnhanced, 0.0);  // the old alpha may not suit the new place
  if (add(shape, law, relaxation, by_direction, cords, alpha, stiffness, sums)) return true;
  std::copy_n(start, kEnhanced, alpha);
  return false;
}

}  // namespace latsch::fe_tire
