// SPDX-License-Identifier: Apache-2.0
// Enhanced strains alpha of the solid-shell, equation (1) of hex8_solid_shell_kernel.h: stresses of
// solid and cords at the points, and Newton's method for sum dV P_alpha^T S = 0. Products with P,
// 48 x 26 numbers, are most of the work; P is the same for all lanes.
//
// Included once per kernel set, by hex8_solid_shell_kernel.h only.
#if defined(LATSCH_FE_TIRE_SOLID_SHELL_ALPHA) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_FE_TIRE_SOLID_SHELL_ALPHA
#undef LATSCH_FE_TIRE_SOLID_SHELL_ALPHA
#else
#define LATSCH_FE_TIRE_SOLID_SHELL_ALPHA
#endif

#include "models/fe_tire/element/hex8_cords.h"
#include "models/fe_tire/element/rubber_law.h"
#include "models/fe_tire/element/solid_shell_strains_kernel.h"

namespace latsch::fe_tire::LATSCH_KERNELS {

inline constexpr double kInnerTolerance = 1e-9;  // strain; the remaining error of alpha enters f
                                                 // quadratically
inline constexpr double kLastStep = 1e-6;        // strain; the step after one this small meets
                                                 // kInnerTolerance
inline constexpr int kInnerIterations = 15;

/// Factorizes a symmetric matrix in place as L D L^T (unit L below the diagonal). Returns false
/// where a pivot vanishes. Negative pivots occur far from equilibrium, under hydrostatic tension
/// beyond G.
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

/// Stresses and tangents at the points, times dV, and the tangent of alpha.
template <class V>
struct InnerOf {
  V S[8][6], D[8][6][6];
  V A[kEnhanced][kEnhanced];  // factors of the tangent of alpha
};

using Inner = InnerOf<V>;

/// Computes S and D at the strain E, times dV. Returns false where det C <= 0.
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

/// Evaluates the laws of all points at alpha; `compatible` are the strains without alpha.
Mask stress_at(const ElementLaw& law, const V (*compatible)[6], const V* alpha, Inner& inner) {
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
  }
  return valid;
}

/// Computes DP[p][c] = sum over r of D P, for the columns first_column ... of P.
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

/// Computes sum_p P[p][row + r] DP[p][c] for `rows` rows of P^T D P.
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

/// Extrapolates S and the cords' S along the step of alpha.
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

/// Solves for alpha by Newton's method. On return alpha is in equilibrium to first order, `inner`
/// is its last linearization, and inner.S is the stress extrapolated to that alpha. An element that
/// has met the tolerance is evaluated again at the same alpha until its neighbors have met it.
LATSCH_INLINE Mask
solve_alpha(const ElementLaw& law, const V* g, Cords& cords, V* alpha, Inner& inner) {
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
  for (int j = 5; j < kEnhanced; ++j) {
    relaxed[j] = law.relaxation * s.volume / (j == 7 ? 9.0 : 3.0);
  }
  const Mask yes = V(1.0) > V(0.0), no = V(0.0) > V(1.0);
  Mask valid = yes, settled = no, last = law.linear && cords.count() == 0 ? yes : no;
  V step[kEnhanced];
  for (int iteration = 0; iteration < kInnerIterations; ++iteration) {
    valid = valid & stress_at(law, compatible, alpha, inner);
    tangent_of_alpha<V>(s, inner, inner.A);
    residual_of_alpha(s, inner, step);
    for (int i = 0; i < kEnhanced; ++i) {
      inner.A[i][i] += relaxed[i];
      step[i] -= relaxed[i] * alpha[i];
    }
    stretch(cords, alpha[0], alpha[1]);
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

}  // namespace latsch::fe_tire::LATSCH_KERNELS
#endif
