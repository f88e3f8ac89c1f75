// SPDX-License-Identifier: Apache-2.0
// Eight-node solid-shell element for walls that consist of few, thin, very different layers of
// nearly incompressible rubber and cords. The formulation is total Lagrangian; the argument of all
// material laws is the Green-Lagrange strain
//
//   E = E_c + (A - <A>) (e - H E_c) + (A - <A>) alpha            <.>: mean over the volume      (1)
//   E_c = (F^T F - 1) / 2 + w c c,   F = sum_a x_a b_a^T,  b_a = <grad N_a>                     (2)
//   e = x_m . x_n - X_m . X_n,  x = x_0 + x_1 xi + x_2 eta + ... + x_123 xi eta zeta            (3)
//   z_m = x_m - F X_m,  c_mj = z_m . F a_j,  a_j: unit vectors along xi, across it, normal (4)
//
// E_c is the strain of the mean deformation gradient. The vector e contains the twelve coefficients
// of the convected strains in xi, eta, zeta that bending, twisting and tapering need
// (hex8_solid_shell_modes.h). H E_c are the values of e in a constant strain E_c, and A converts
// convected strain at a point to Cartesian strain. The omitted strains are those that lock: shear
// that varies along its own direction (2 E_13 along xi, as in the assumed strains of Dvorkin and
// Bathe), in-plane shear along xi and eta, and the thickness strain of a curved element's middle.
// Six and twelve strains represent the 24 - 6 deformations exactly once: there is no hourglass mode
// and no hourglass stiffness.
//   The twelve modes have zero values and slopes in a constant strain, and <A - <A>> = 0, so
// elements of any shape pass every patch test [Simo & Hughes 1986]. In curved walls the thickness
// at the nodes then changes a little, instead of locking. The mean of the quadratic terms, w c c,
// is of second order in these tests, too. With this term the tension of an inflated wall acts on
// the hourglass shapes. The square of a c belongs in E_11 or E_22 exactly if the strain that is
// linear in that c is kept: z_12 along xi (E_11), across it (E_22) and along the normal (twist,
// both); z_13 along xi and across it (E_11); z_23 along xi and across it (E_22). If a shear is
// omitted, an edge that leans counts as rotated without strain, and its square alone would dilate
// the element. A pressure of the order of G (b/L)^2 or more would then buckle long elements
// alternately in and out. For the same reason the thickness strain has no such squares.
//   alpha: E_11 along xi, E_22 along eta, E_33 along zeta, xi zeta and eta zeta (Poisson's
// contraction in bending, in plane and through the thickness) and E_33 along xi, eta, xi eta.
// Without the last three, the thickness at the nodes of an element of constant volume would be
// fixed by its in-plane strain. These three are stiffened by the shear modulus; otherwise nodes
// could move alternately in and out.
//   alpha solves sum dV P_alpha^T S = 0 by Newton's method, so f is the gradient and K the Hessian
// of the condensed energy.
//   Enhanced strain in E and the Taylor expansion follow [Simo & Rifai 1990, IJNME 29; Klinkel,
// Gruttmann & Wagner 1999, Comput. Struct. 71; Schwarze & Reese 2009, IJNME 80].
//
// The generalized strains (2) to (4) are in solid_shell_strains_kernel.h; alpha, forces and
// stiffness are here. Forces and stiffness are summed in the modal vectors (hex8_sums.h), where b
// and gamma are short sums and every coefficient of e is a product of two vectors. Products with P,
// 48 x 26 numbers, are most of the work; P is the same for all lanes.
//
// This file is included once per kernel set, by hex8_kernels.h only.
#if defined(LATSCH_FE_TIRE_HEX8_SOLID_SHELL) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_FE_TIRE_HEX8_SOLID_SHELL
#undef LATSCH_FE_TIRE_HEX8_SOLID_SHELL
#else
#define LATSCH_FE_TIRE_HEX8_SOLID_SHELL
#endif

#include "models/fe_tire/element/hex8_cords.h"
#include "models/fe_tire/element/rubber_law.h"
#include "models/fe_tire/element/solid_shell_strains_kernel.h"

namespace latsch::fe_tire::LATSCH_KERNELS {

// Strain, convergence tolerance of alpha. The remaining error of alpha affects f only
// quadratically.
inline constexpr double kInnerTolerance = 1e-9;
// Strain. After a step of alpha this small, the next one meets kInnerTolerance.
inline constexpr double kLastStep = 1e-6;
inline constexpr int kInnerIterations = 15;

/// Factorizes a symmetric matrix in place as L D L^T (unit L below the diagonal). Returns false in
/// lanes in which a pivot vanishes. Negative pivots occur far from equilibrium, under hydrostatic
/// tension larger than G.
LATSCH_INLINE Mask factorize(V (*A)[kEnhanced]) {
  Mask regular = V(1.0) > V(0.0);
  for (int j = 0; j < kEnhanced; ++j) {
    const V diagonal = abs(A[j][j]);
    for (int k = 0; k < j; ++k) {
      const V l = A[j][k] * A[k][k];
      for (int i = j; i < kEnhanced; ++i) A[i][j] -= A[i][k] * l;
    }
    regular = regular & (abs(A[j][j]) > 1e-9 * diagonal);
    const V inverse = 1.0 / A[j][j];
    for (int i = j + 1; i < kEnhanced; ++i) A[i][j] *= inverse;
  }
  return regular;
}

LATSCH_INLINE void solve(const V (*A)[kEnhanced], V* x) {
  for (int i = 1; i < kEnhanced; ++i) {
    for (int j = 0; j < i; ++j) x[i] -= A[i][j] * x[j];
  }
  for (int i = 0; i < kEnhanced; ++i) x[i] = x[i] / A[i][i];
  for (int i = kEnhanced - 2; i >= 0; --i) {
    for (int j = i + 1; j < kEnhanced; ++j) x[i] -= A[j][i] * x[j];
  }
}

/// Stresses and tangents at the points, multiplied by dV, and the tangent of alpha.
template <class V>
struct InnerOf {
  V S[8][6], D[8][6][6];
  V A[kEnhanced][kEnhanced];  // factorized tangent of alpha
};

using Inner = InnerOf<V>;

/// Computes stress S and tangent D at the strain E, multiplied by dV. Returns false in lanes in
/// which det C <= 0.
LATSCH_INLINE Mask stress(const ElementLaw& law, double dV, const V* E, V* S, V (*D)[6]) {
  V det;
  if (!law.linear) {
    det = rubber_law::stress(law.rubber, E, S, D);
    for (int a = 0; a < 6; ++a) {
      S[a] = dV * S[a];
      for (int b = 0; b < 6; ++b) D[a][b] = dV * D[a][b];
    }
  } else {
    for (int a = 0; a < 6; ++a) {
      V s = law.D[a][0] * E[0];
      D[a][0] = dV * law.D[a][0];
      for (int b = 1; b < 6; ++b) {
        s += law.D[a][b] * E[b];
        D[a][b] = dV * law.D[a][b];
      }
      S[a] = dV * s;
    }
    V C[6], Ci[6];
    rubber_law::invert(E, C, Ci, det);
  }
  return det > V(0.0);
}

/// Dead stresses of the elements in lanes `first` ...
struct DeadStresses {
  const PointStresses* of = nullptr;  // null: none
  int first = 0;

  explicit operator bool() const { return of != nullptr; }
  V solid(int q, int r) const { return load(of->solid[q][r] + first); }
  V gradient(int j) const { return load(of->gradients[j] + first); }
  V cord(int k, int q) const { return load(of->cords[k][q] + first); }
};

/// Evaluates the laws at all points for the given alpha. `compatible` holds the strains without
/// alpha.
Mask stress_at(const ElementLaw& law,
               const V (*compatible)[6],
               const V* alpha,
               const DeadStresses& dead,
               Inner& inner) {
  const SolidShellShape& s = law.shape->solid_shell;
  Mask valid = V(1.0) > V(0.0);
  for (int q = 0; q < 8; ++q) {
    V E[6];
    for (int r = 0; r < 6; ++r) {
      V sum = compatible[q][r];
      for (int j = 0; j < kEnhanced; ++j) sum += s.P[q][r][kStrains + j] * alpha[j];
      E[r] = sum;
    }
    valid = valid & stress(law, law.shape->dV[q], E, inner.S[q], inner.D[q]);
    if (!dead) continue;
    for (int r = 0; r < 6; ++r) inner.S[q][r] += law.shape->dV[q] * dead.solid(q, r);
  }
  return valid;
}

/// Computes DP[p][c], the sum over r of D P at point p, for the columns of P from first_column on.
template <int columns, class V>
LATSCH_INLINE void times_P(const Operators<V>& s,
                           const InnerOf<V>& inner,
                           int first_column,
                           V (*DP)[columns]) {
  for (int q = 0; q < 8; ++q) {
    for (int r = 0; r < 6; r += 2) {
      V acc[2][columns];
      for (int c = 0; c < columns; ++c) {
        const V P = s.P[q][0][first_column + c];
        acc[0][c] = P * inner.D[q][r][0];
        acc[1][c] = P * inner.D[q][r + 1][0];
      }
      for (int k = 1; k < 6; ++k) {
        const V d0 = inner.D[q][r][k], d1 = inner.D[q][r + 1][k];
        for (int c = 0; c < columns; ++c) {
          const V P = s.P[q][k][first_column + c];
          acc[0][c] += P * d0;
          acc[1][c] += P * d1;
        }
      }
      for (int c = 0; c < columns; ++c) {
        DP[6 * q + r][c] = acc[0][c];
        DP[6 * q + r + 1][c] = acc[1][c];
      }
    }
  }
}

/// Computes the sum over points p of P[p][row + r] DP[p][c], for `rows` rows of P^T D P.
template <int rows, int columns, class V, class Store>
LATSCH_INLINE void times_P_transposed(const Operators<V>& s,
                                      int row,
                                      const V (*DP)[columns],
                                      const Store& store) {
  const auto* P = &s.P[0][0][0] + row;
  V acc[rows][columns];
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) acc[r][c] = P[r] * DP[0][c];
  }
  for (int p = 1; p < 48; ++p) {
    P += kColumns;
    V b[columns];
    for (int c = 0; c < columns; ++c) b[c] = DP[p][c];
    for (int r = 0; r < rows; ++r) {
      const V a = P[r];
      for (int c = 0; c < columns; ++c) acc[r][c] += a * b[c];
    }
  }
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) store(r, c, acc[r][c]);
  }
}

/// Computes the lower triangle of the tangent of alpha, P_alpha^T D P_alpha.
template <class V>
void tangent_of_alpha(const Operators<V>& s, const InnerOf<V>& inner, V (*A)[kEnhanced]) {
  for (int column = 0; column < kEnhanced; column += 2) {
    V DP[48][2];
    times_P<2, V>(s, inner, kStrains + column, DP);
    for (int row = column & 4; row < kEnhanced; row += 4) {
      times_P_transposed<4, 2, V>(s, kStrains + row, DP, [&](int r, int c, const V& value) {
        A[row + r][column + c] = value;
      });
    }
  }
}

/// Computes the residual of alpha, -P_alpha^T S.
LATSCH_INLINE void residual_of_alpha(const SolidShellShape& s, const Inner& inner, V* residual) {
  for (int j = 0; j < kEnhanced; ++j) residual[j] = 0.0;
  for (int q = 0; q < 8; ++q) {
    for (int r = 0; r < 6; ++r) {
      for (int j = 0; j < kEnhanced; ++j) {
        residual[j] -= s.P[q][r][kStrains + j] * inner.S[q][r];
      }
    }
  }
}

/// Extrapolates the stresses S of solid and cords linearly along the step of alpha.
LATSCH_INLINE void extrapolate(const SolidShellShape& s,
                               const V* step,
                               Cords& cords,
                               Inner& inner) {
  for (int q = 0; q < 8; ++q) {
    V dE[6];
    for (int r = 0; r < 6; ++r) {
      V sum = s.P[q][r][kStrains] * step[0];
      for (int j = 1; j < kEnhanced; ++j) sum += s.P[q][r][kStrains + j] * step[j];
      dE[r] = sum;
    }
    for (int c = 0; c < 6; ++c) {
      for (int r = 0; r < 6; ++r) inner.S[q][c] += inner.D[q][c][r] * dE[r];
    }
  }
  for (int k = 0; k < cords.count(); ++k) {
    for (int q = 0; q < 4; ++q) {
      const double* p = cords.laws[k].points[q].p;
      Cords::Point& point = cords.sheets[k].points[q];
      point.S += point.tangent * (p[0] * step[0] + p[1] * step[1]);
    }
  }
}

/// Adds the dead stresses of cords to those of their laws.
LATSCH_INLINE void add_dead(const DeadStresses& dead, Cords& cords) {
  for (int k = 0; k < cords.count(); ++k) {
    for (int q = 0; q < 4; ++q) cords.sheets[k].points[q].S += dead.cord(k, q);
  }
}

/// Solves for alpha by Newton's method. On return alpha is in equilibrium to first order, `inner`
/// is its last linearization, and inner.S is the stress extrapolated to that alpha. Lanes whose
/// element has converged are evaluated again at the same alpha until all lanes have converged.
LATSCH_INLINE Mask solve_alpha(const ElementLaw& law,
                               const V* g,
                               Cords& cords,
                               V* alpha,
                               Inner& inner,
                               const DeadStresses& dead = {}) {
  const SolidShellShape& s = law.shape->solid_shell;
  V compatible[8][6];
  for (int q = 0; q < 8; ++q) {
    for (int r = 0; r < 6; ++r) {
      V sum = s.P[q][r][0] * g[0];
      for (int j = 1; j < kStrains; ++j) sum += s.P[q][r][j] * g[j];
      compatible[q][r] = sum;
    }
  }
  double relaxed[kEnhanced] = {};
  V still[kEnhanced];  // residual that does not change with alpha
  for (V& value : still) value = 0.0;
  for (int j = 5; j < kEnhanced; ++j) {
    relaxed[j] = law.relaxation * s.volume / (j == 7 ? 9.0 : 3.0);
    if (dead) still[j] = (s.volume / (j == 7 ? 9.0 : 3.0)) * dead.gradient(j - 5);
  }
  const Mask yes = V(1.0) > V(0.0), no = V(0.0) > V(1.0);
  Mask valid = yes, settled = no, last = law.linear && cords.count() == 0 ? yes : no;
  V step[kEnhanced];
  for (int iteration = 0; iteration < kInnerIterations; ++iteration) {
    valid = valid & stress_at(law, compatible, alpha, dead, inner);
    tangent_of_alpha<V>(s, inner, inner.A);
    residual_of_alpha(s, inner, step);
    for (int i = 0; i < kEnhanced; ++i) {
      inner.A[i][i] += relaxed[i];
      step[i] -= relaxed[i] * alpha[i];
      if (dead) step[i] -= still[i];
    }
    stretch(cords, alpha[0], alpha[1]);
    if (dead) add_dead(dead, cords);
    for (int k = 0; k < cords.count(); ++k) {
      for (int q = 0; q < 4; ++q) {
        const CordSheet::Point& cord = cords.laws[k].points[q];
        const Cords::Point& point = cords.sheets[k].points[q];
        const V S = cord.dV * point.S, tangent = cord.dV * point.tangent;
        step[0] -= cord.p[0] * S;
        step[1] -= cord.p[1] * S;
        inner.A[0][0] += cord.p[0] * cord.p[0] * tangent;
        inner.A[1][0] += cord.p[0] * cord.p[1] * tangent;
        inner.A[1][1] += cord.p[1] * cord.p[1] * tangent;
      }
    }
    valid = valid & factorize(inner.A);
    solve(inner.A, step);
    V largest = 0.0;
    for (int j = 0; j < kEnhanced; ++j) largest = larger(largest, abs(step[j]));
    settled = settled | last | (largest < V(kInnerTolerance));
    if (every(settled | negated(valid))) break;
    last = largest < V(kLastStep);
    for (int j = 0; j < kEnhanced; ++j) alpha[j] = select(settled, alpha[j], alpha[j] + step[j]);
  }
  extrapolate(s, step, cords, inner);
  for (int j = 0; j < kEnhanced; ++j) alpha[j] += step[j];
  return valid & settled;
}

/// Computes the tangent D of the generalized strains, and the matrix Da that couples them with
/// alpha.
template <class V>
void tangents(const Operators<V>& s, const InnerOf<V>& inner, V (*D)[kStrains], V (*Da)[kStrains]) {
  for (int column = 0; column < kStrains; column += 3) {
    V DP[48][3];
    times_P<3, V>(s, inner, column, DP);
    for (int row = 0; row < column + 3; row += 3) {
      times_P_transposed<3, 3, V>(s, row, DP, [&](int r, int c, const V& value) {
        D[row + r][column + c] = value;
        D[column + c][row + r] = value;
      });
    }
    for (int row = 0; row < kEnhanced; row += 4) {
      times_P_transposed<4, 3, V>(s, kStrains + row, DP, [&](int r, int c, const V& value) {
        Da[row + r][column + c] = value;
      });
    }
  }
}

/// Multiplies `rows`, which are tangents of the generalized strains, by their derivatives (B,
/// de/dx).
template <class V>
void times_B(const V (*rows)[kStrains],
             int count,
             const V (*B)[3][kModes],
             const V (*x)[3],
             V (*product)[3][kModes]) {
  for (int row = 0; row < count; ++row) {
    const V* d = rows[row];
    for (int i = 0; i < 3; ++i) {
      V sum[kModes];
      for (int m = 0; m < kModes; ++m) sum[m] = d[0] * B[0][i][m];
      for (int r = 1; r < 6; ++r) {
        for (int m = 0; m < kModes; ++m) sum[m] += d[r] * B[r][i][m];
      }
      for (const auto& [e, m, n] : kPairs) {
        sum[m] += d[6 + e] * x[n][i];
        sum[n] += d[6 + e] * x[m][i];
      }
      for (int m = 0; m < kModes; ++m) product[row][i][m] = sum[m];
    }
  }
}

/// Adds (de/dx)^T DB to K, for the rows of the strains e.
template <class V>
void add_pairs(const V (*x)[3], const V (*DB)[3][kModes], ModalSumsOf<V>& sums) {
  for (int block = 0; block < 6; ++block) {
    const int i = voigt::kRow[block], j = voigt::kColumn[block];
    for (const auto& [e, m, n] : kPairs) {
      const V x_m = x[m][i], x_n = x[n][i];
      const V* row = DB[6 + e][j];
      V *K_m = sums.K[block][m], *K_n = sums.K[block][n];
      for (int c = i == j ? static_cast<int>(m) : 0; c < kModes; ++c) K_m[c] += x_n * row[c];
      for (int c = i == j ? static_cast<int>(n) : 0; c < kModes; ++c) K_n[c] += x_m * row[c];
    }
  }
}

/// Computes K_a <- L^-1 K_a and scaled = -D^-1 L^-1 K_a, where L D L^T is the factorized tangent of
/// alpha. The product of both is what the condensation of alpha adds to K.
template <class V>
void condense(const InnerOf<V>& inner, V (*Ka)[3][kModes], V (*scaled)[3][kModes]) {
  for (int k = 0; k < kEnhanced; ++k) {
    const V inverse = -1.0 / inner.A[k][k];
    for (int i = 0; i < 3; ++i) {
      for (int m = 0; m < kModes; ++m) {
        V sum = Ka[k][i][m];
        for (int j = 0; j < k; ++j) sum -= inner.A[k][j] * Ka[j][i][m];
        Ka[k][i][m] = sum;
        scaled[k][i][m] = inverse * sum;
      }
    }
  }
}

/// Adds the stiffness of solid and cords. t: stresses of the generalized strains.
template <class V>
void add_stiffness(const Operators<V>& s,
                   const KinematicsOf<V>& k,
                   const InnerOf<V>& inner,
                   const V* t,
                   const CordsOf<V>& cords,
                   ModalSumsOf<V>& sums) {
  // First rows of the parts of one long product: E_c, squares, alpha.
  constexpr int kSquareRow = 6, kAlphaRow = kSquareRow + kSquareCount,
                kRows = kAlphaRow + kEnhanced;
  V left[kRows][3][kModes], right[kRows][3][kModes], DB[kStrains][3][kModes];
  V D[kStrains][kStrains], Da[kEnhanced][kStrains];
  hourglass_operator<V>(s, k, left + kSquareRow);
  strain_operator<V>(s, k, left + kSquareRow, left);
  tangents<V>(s, inner, D, Da);
  times_B<V>(D, kStrains, left, k.x, DB);
  times_B<V>(Da, kEnhanced, left, k.x, left + kAlphaRow);
  std::memcpy(right, DB, 6 * sizeof DB[0]);
  add_stiffness<V>(cords, sums, left + kAlphaRow);
  condense<V>(inner, left + kAlphaRow, right + kAlphaRow);
  add_stress_stiffness<V>(s, k, left + kSquareRow, t, right + kSquareRow, sums);
  add_product<V>(left, right, kRows, sums);
  add_pairs<V>(k.x, DB, sums);
}

/// Intermediate results from which the forces and the stiffness of an element are computed.
template <class V>
struct SolidShellState {
  KinematicsOf<V> k;
  InnerOf<V> inner;
  V t[kStrains];  // stresses of the generalized strains
};

/// Adds the forces of solid and cords for the modal vectors in state.k.x. alpha is solved from the
/// given starting values. In lanes that fail, sums and state are undefined.
Mask add_solid_shell_forces(const ElementLaw& law,
                            SolidShellState<V>& state,
                            Cords& cords,
                            V* alpha,
                            ModalSums& sums,
                            const DeadStresses& dead) {
  const SolidShellShape& s = law.shape->solid_shell;
  const Mask upright = follow(s, state.k);
  V g[kStrains];
  generalized_strains(s, state.k, g);
  const Mask valid = upright & solve_alpha(law, g, cords, alpha, state.inner, dead);
  if (!any(valid)) return valid;
  for (V& entry : state.t) entry = 0.0;
  for (int q = 0; q < 8; ++q) {
    for (int r = 0; r < 6; ++r) {
      for (int j = 0; j < kStrains; ++j) state.t[j] += s.P[q][r][j] * state.inner.S[q][r];
    }
  }
  add_forces(s, state.k, state.t, sums);
  add_forces(cords, sums);
  return valid;
}

}  // namespace latsch::fe_tire::LATSCH_KERNELS
#endif
