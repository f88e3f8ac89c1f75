// SPDX-License-Identifier: Apache-2.0
// Equations (M.1) to (M.4) of hex8_motions.h, in both elements.
//
// Derivatives of strains along a motion are written out; stresses S, S', S'' follow from them by
// the law's tangent D and its own derivative along a strain, and forces are those of the kernels,
// differentiated twice by the rule of products.
//
// Read once a kernel set, by hex8_kernels.h alone.
#if defined(LATSCH_FE_TIRE_HEX8_MOTIONS) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_FE_TIRE_HEX8_MOTIONS
#undef LATSCH_FE_TIRE_HEX8_MOTIONS
#else
#define LATSCH_FE_TIRE_HEX8_MOTIONS
#endif

#include "models/fe_tire/element/hex8_full_integration_kernel.h"
#include "models/fe_tire/element/pressure_kernel.h"

namespace latsch::fe_tire::LATSCH_KERNELS {

inline constexpr int kPoints = 8;

/// Minors of a symmetric matrix in Voigt order, of two of them: cof(a + b) = cof a + mixed + cof b.
LATSCH_INLINE void minors(const V* a, V* cof) {
  cof[0] = a[1] * a[2] - a[4] * a[4];
  cof[1] = a[0] * a[2] - a[5] * a[5];
  cof[2] = a[0] * a[1] - a[3] * a[3];
  cof[3] = a[4] * a[5] - a[3] * a[2];
  cof[4] = a[3] * a[5] - a[0] * a[4];
  cof[5] = a[3] * a[4] - a[1] * a[5];
}
LATSCH_INLINE void mixed_minors(const V* a, const V* b, V* cof) {
  cof[0] = (a[1] * b[2] + b[1] * a[2]) - 2.0 * (a[4] * b[4]);
  cof[1] = (a[0] * b[2] + b[0] * a[2]) - 2.0 * (a[5] * b[5]);
  cof[2] = (a[0] * b[1] + b[0] * a[1]) - 2.0 * (a[3] * b[3]);
  cof[3] = (a[4] * b[5] + b[4] * a[5]) - (a[3] * b[2] + b[3] * a[2]);
  cof[4] = (a[3] * b[5] + b[3] * a[5]) - (a[0] * b[4] + b[0] * a[4]);
  cof[5] = (a[3] * b[4] + b[3] * a[4]) - (a[1] * b[5] + b[1] * a[5]);
}
/// a : b of symmetric matrices.
LATSCH_INLINE V double_dot(const V* a, const V* b) {
  const V shear = a[3] * b[3] + (a[4] * b[4] + a[5] * b[5]);
  return 2.0 * shear + (a[0] * b[0] + (a[1] * b[1] + a[2] * b[2]));
}

/// Rubber at a point, what is the same along all strains.
struct RubberPoint {
  V C[6], cof[6], det, inverse, J, I1, I2, a, b;
};

LATSCH_INLINE void prepare(const Hyperelastic& law, const V* E, RubberPoint& p) {
  for (int k = 0; k < 6; ++k) p.C[k] = k < 3 ? 2.0 * E[k] + 1.0 : E[k];
  minors(p.C, p.cof);
  p.det = p.C[0] * p.cof[0] + (p.C[3] * p.cof[3] + p.C[5] * p.cof[5]);
  p.inverse = 1.0 / p.det;
  p.J = sqrt(p.det);
  const V j = inverse_cube_root(p.det);
  p.I1 = p.C[0] + p.C[1] + p.C[2];
  p.I2 = 0.5 * (p.I1 * p.I1 - double_dot(p.C, p.C));
  p.a = 2.0 * law.C10 * j;
  p.b = 2.0 * law.C01 * (j * j);
}

/// Coefficients of e and e^2 in (1 + a1 e + a2 e^2)^n.
struct Series {
  V first, second;
};
LATSCH_INLINE Series power(double n, const V& a1, const V& a2) {
  return {n * a1, n * a2 + (0.5 * n * (n - 1.0)) * (a1 * a1)};
}

/// Second derivative of S (rubber_law.h) along the strain E + e E1.
LATSCH_INLINE void second_stress(const Hyperelastic& law, const RubberPoint& p, const V* E1, V* S) {
  V c[6], cof1[6], cof2[6];
  for (int k = 0; k < 6; ++k) c[k] = k < 3 ? V(2.0 * E1[k]) : E1[k];
  mixed_minors(p.C, c, cof1);
  minors(c, cof2);
  const V a1 = double_dot(p.cof, c) * p.inverse, a2 = double_dot(p.C, cof2) * p.inverse;
  const Series J = power(0.5, a1, a2), j = power(-1.0 / 3.0, a1, a2);
  const Series jj = power(-2.0 / 3.0, a1, a2), v = power(-1.0, a1, a2);
  const V t = c[0] + c[1] + c[2];
  const V i1 = p.I1 * t - double_dot(p.C, c), i2 = 0.5 * (t * t - double_dot(c, c));
  const V p0 = law.K * (p.det - p.J), p1 = law.K * (p.det * a1 - p.J * J.first);
  const V p2 = law.K * (p.det * a2 - p.J * J.second);
  const V a = p.a * (1.0 / 3.0), b = p.b * (2.0 / 3.0);
  const V s0 = p0 - (a * p.I1 + b * p.I2);
  const V s1 = p1 - (a * (j.first * p.I1 + t) + b * (jj.first * p.I2 + i1));
  const V s2 =
      p2 - (a * (j.second * p.I1 + j.first * t) + b * (jj.second * p.I2 + (jj.first * i1 + i2)));
  const V q0 = s0 * p.inverse, q1 = (s1 + s0 * v.first) * p.inverse;
  const V q2 = (s2 + (s1 * v.first + s0 * v.second)) * p.inverse;
  for (int k = 0; k < 6; ++k) {
    const V B0 = k < 3 ? p.I1 - p.C[k] : -p.C[k], B1 = k < 3 ? t - c[k] : -c[k];
    V sum = q0 * cof2[k] + (q1 * cof1[k] + q2 * p.cof[k]);
    sum += p.b * (jj.second * B0 + jj.first * B1);
    if (k < 3) sum += p.a * j.second;
    S[k] = 2.0 * sum;
  }
}

/// First derivatives of the generalized strains along a motion, and of the squares' c.
LATSCH_INLINE void first_strains(
    const SolidShellShape& s, const Kinematics& k, const Kinematics& m, V* c1, V* g) {
  using voigt::kColumn, voigt::kRow;
  for (int r = 0; r < 6; ++r) {
    const V* Fa = k.F[kRow[r]];
    g[r] = r < 3 ? dot(m.F[r], Fa) : dot(m.F[kRow[r]], k.F[kColumn[r]]) + dot(Fa, m.F[kColumn[r]]);
  }
  for (int q = 0; q < kSquareCount; ++q) {
    const auto [z, axis] = kSquares[q];
    c1[q] = dot(m.z[z], k.d[axis]) + dot(k.z[z], m.d[axis]);
    const V square = 2.0 * (k.c[q] * c1[q]);
    for (int r = 0; r < 6; ++r) g[r] += s.w[r][q] * square;
  }
  for (int e = 0; e < 12; ++e) g[6 + e] = 0.0;
  for (const auto& [e, a, b] : kPairs) g[6 + e] += dot(m.x[a], k.x[b]) + dot(k.x[a], m.x[b]);
}

/// Second derivatives along the motion.
LATSCH_INLINE void second_strains(
    const SolidShellShape& s, const Kinematics& k, const Kinematics& m, const V* c1, V* g) {
  using voigt::kColumn, voigt::kRow;
  for (int r = 0; r < 6; ++r) {
    const V C = dot(m.F[kRow[r]], m.F[kColumn[r]]);
    g[r] = r < 3 ? C : V(2.0 * C);
  }
  for (int q = 0; q < kSquareCount; ++q) {
    const V square = 2.0 * (c1[q] * c1[q]) + 4.0 * (k.c[q] * m.c[q]);
    for (int r = 0; r < 6; ++r) g[r] += s.w[r][q] * square;
  }
  for (int e = 0; e < 12; ++e) g[6 + e] = 0.0;
  for (const auto& [e, a, b] : kPairs) g[6 + e] += 2.0 * dot(m.x[a], m.x[b]);
}

/// Second derivative of f = B^T t along the motion; t[0], t[1], t[2]: t and its derivatives.
void add_second_forces(const SolidShellShape& s,
                       const Kinematics& k,
                       const Kinematics& m,
                       const V* c1,
                       const V (*t)[kStrains],
                       ModalSums& sums) {
  V T1[kSquareCount], T2[kSquareCount];
  for (int q = 0; q < kSquareCount; ++q) {
    V tau[3];
    for (int n = 0; n < 3; ++n) {
      tau[n] = s.w[0][q] * t[n][0];
      for (int r = 1; r < 6; ++r) tau[n] += s.w[r][q] * t[n][r];
    }
    T1[q] = 2.0 * (c1[q] * tau[0] + k.c[q] * tau[1]);
    T2[q] = 4.0 * (m.c[q] * tau[0]) + (4.0 * (c1[q] * tau[1]) + 2.0 * (k.c[q] * tau[2]));
  }
  const auto times = [](const V* F, const V* t, V* Ft) {
    Ft[0] = F[0] * t[0] + (F[1] * t[3] + F[2] * t[5]);
    Ft[1] = F[0] * t[3] + (F[1] * t[1] + F[2] * t[4]);
    Ft[2] = F[0] * t[5] + (F[1] * t[4] + F[2] * t[2]);
  };
  for (int i = 0; i < 3; ++i) {
    const V F[3] = {k.F[0][i], k.F[1][i], k.F[2][i]}, dF[3] = {m.F[0][i], m.F[1][i], m.F[2][i]};
    V Ft[3], dFt[3];
    times(F, t[2], Ft);
    times(dF, t[1], dFt);
    V by_z[3] = {V(0.0), V(0.0), V(0.0)}, by_axis[3] = {V(0.0), V(0.0), V(0.0)};
    for (int q = 0; q < kSquareCount; ++q) {
      const auto [z, j] = kSquares[q];
      by_z[z] += T2[q] * k.d[j][i] + 2.0 * (T1[q] * m.d[j][i]);
      by_axis[j] += T2[q] * k.z[z][i] + 2.0 * (T1[q] * m.z[z][i]);
    }
    for (int n = 0; n < kModes; ++n) {
      V sum = sums.f[i][n];
      for (int j = 0; j < 3; ++j) {
        sum += s.b[n][j] * (Ft[j] + 2.0 * dFt[j]);
        sum += s.gamma[n][j] * by_z[j];
        sum += s.along[n][j] * by_axis[j];
      }
      sums.f[i][n] = sum;
    }
    for (const auto& [e, a, b] : kPairs) {
      sums.f[i][a] += t[2][6 + e] * k.x[b][i] + 2.0 * (t[1][6 + e] * m.x[b][i]);
      sums.f[i][b] += t[2][6 + e] * k.x[a][i] + 2.0 * (t[1][6 + e] * m.x[a][i]);
    }
  }
}

/// sum W_mn a_m . b_n of a layer's points is W : G of this.
LATSCH_INLINE void gram(const V (*a)[3], const V (*b)[3], V* G) {
  for (int m = 0; m < 3; ++m) G[m] = dot(a[m], b[m]);
  G[3] = dot(a[0], b[1]) + dot(a[1], b[0]);
  G[4] = dot(a[1], b[2]) + dot(a[2], b[1]);
  G[5] = dot(a[0], b[2]) + dot(a[2], b[0]);
}
LATSCH_INLINE V times_gram(const CordSheet::Point& point, const V* G) {
  const auto& W = point.W;
  return (W[0][1] * G[3] + (W[1][2] * G[4] + W[0][2] * G[5])) +
         (W[0][0] * G[0] + (W[1][1] * G[1] + W[2][2] * G[2]));
}
LATSCH_INLINE void vectors_of(const V (*x)[3], double zeta, V (*y)[3]) {
  for (int m = 0; m < 3; ++m) {
    for (int i = 0; i < 3; ++i) y[m][i] = zeta * x[kThrough[m]][i] + x[kInPlane[m]][i];
  }
}
/// d2S/de2 of cord_law.h.
LATSCH_INLINE V bend_of(const CordLayer& layer, const V& e) {
  constexpr double w = kCordTransition;
  const V square = e * e + w * w;
  return (0.5 * w * w * (layer.E_tension - layer.E_compression)) / (square * sqrt(square));
}

/// An element's state, and what all motions about it share.
struct MotionState {
  Kinematics k;
  V x[24], alpha[kEnhanced], E[kPoints][6];
  V t[kStrains], D[kStrains][kStrains], Da[kEnhanced][kStrains];
  Inner inner;
  RubberPoint rubber[kPoints];
};

/// False where the element has no state. `cords` receive theirs.
Mask set_state(
    const ElementLaw& law, int first, const ElementBatch& batch, MotionState& state, Cords& cords) {
  const HexShape& shape = *law.shape;
  const SolidShellShape& s = shape.solid_shell;
  for (int n = 0; n < 24; ++n) state.x[n] = load(batch.u[n] + first) + shape.X.data()[n];
  for (int j = 0; j < kEnhanced; ++j) state.alpha[j] = load(batch.alpha[j] + first);
  modal_vectors(state.x, state.k.x);
  follow(state.k.x, cords);
  if (shape.kind == ElementKind::full_integration) {
    stretch(cords, 0.0, 0.0);
    return V(1.0) > V(0.0);
  }
  Mask valid = follow(s, state.k);
  V g[kStrains];
  generalized_strains(s, state.k, g);
  valid = valid & solve_alpha(law, g, cords, state.alpha, state.inner);
  stretch(cords, state.alpha[0], state.alpha[1]);
  for (int j = 0; j < kStrains; ++j) state.t[j] = 0.0;
  for (int q = 0; q < kPoints; ++q) {
    for (int r = 0; r < 6; ++r) {
      V sum = s.P[q][r][0] * g[0];
      for (int j = 1; j < kStrains; ++j) sum += s.P[q][r][j] * g[j];
      for (int j = 0; j < kEnhanced; ++j) sum += s.P[q][r][kStrains + j] * state.alpha[j];
      state.E[q][r] = sum;
      for (int j = 0; j < kStrains; ++j) state.t[j] += s.P[q][r][j] * state.inner.S[q][r];
    }
    if (!law.linear) prepare(law.rubber, state.E[q], state.rubber[q]);
  }
  tangents(s, state.inner, state.D, state.Da);
  return valid;
}

/// Response of alpha to derivatives g of the generalized strains and e of the cords' (M.1): the
/// terms that stand in `response` already are moved with it.
LATSCH_INLINE void respond(
    const MotionState& state, const Cords& cords, const V* g, const V (*e)[4], V* response) {
  for (int j = 0; j < kEnhanced; ++j) {
    for (int n = 0; n < kStrains; ++n) response[j] += state.Da[j][n] * g[n];
  }
  for (int l = 0; l < cords.count(); ++l) {
    for (int q = 0; q < 4; ++q) {
      const CordSheet::Point& point = cords.laws[l].points[q];
      const V S = point.dV * (cords.sheets[l].points[q].tangent * e[l][q]);
      response[0] += point.p[0] * S;
      response[1] += point.p[1] * S;
    }
  }
  solve(state.inner.A, response);
  for (int j = 0; j < kEnhanced; ++j) response[j] = -response[j];
}

/// First derivatives along a motion: of generalized strains, cords' strains, alpha.
LATSCH_INLINE void first_response(const SolidShellShape& s,
                                  const MotionState& state,
                                  const Cords& cords,
                                  const Kinematics& m,
                                  V* c1,
                                  V* g,
                                  V (*e)[4],
                                  V* alpha) {
  first_strains(s, state.k, m, c1, g);
  for (int l = 0; l < cords.count(); ++l) {
    V y[3][3], G[6];
    vectors_of(m.x, cords.laws[l].zeta, y);
    gram(y, cords.sheets[l].y, G);
    for (int q = 0; q < 4; ++q) e[l][q] = times_gram(cords.laws[l].points[q], G);
  }
  for (int j = 0; j < kEnhanced; ++j) alpha[j] = 0.0;
  respond(state, cords, g, e, alpha);
}

LATSCH_INLINE void motion_of(const HexShape& shape,
                             const double (*at)[ElementBatch::kLanes],
                             int first,
                             V* x,
                             Kinematics& m) {
  for (int n = 0; n < 24; ++n) x[n] = load(at[n] + first);
  modal_vectors(x, m.x);
  if (shape.kind == ElementKind::solid_shell) follow(shape.solid_shell, m);
}

/// Second derivative of the cords' forces; strains e1 and e2 are whole.
void add_second_forces(
    const Cords& cords, const Kinematics& m, const V (*e1)[4], const V (*e2)[4], ModalSums& sums) {
  for (int l = 0; l < cords.count(); ++l) {
    const CordSheet& law = cords.laws[l];
    const Cords::Sheet& sheet = cords.sheets[l];
    V y[3][3], f[3][3];
    vectors_of(m.x, law.zeta, y);
    for (V& v : std::span(&f[0][0], 9)) v = 0.0;
    for (int q = 0; q < 4; ++q) {
      const CordSheet::Point& point = law.points[q];
      const V& e = sheet.points[q].e;
      const V S1 = (2.0 * point.dV) * (sheet.points[q].tangent * e1[l][q]);
      const V S2 = point.dV * (bend_of(law.layer, e) * (e1[l][q] * e1[l][q]) +
                               sheet.points[q].tangent * e2[l][q]);
      V b[3][3], db[3][3];
      strain_operator(point, sheet.y, b);
      strain_operator(point, y, db);
      for (int n = 0; n < 3; ++n) {
        for (int i = 0; i < 3; ++i) f[n][i] += S2 * b[n][i] + S1 * db[n][i];
      }
    }
    for (int n = 0; n < 3; ++n) {
      for (int i = 0; i < 3; ++i) {
        sums.f[i][kInPlane[n]] += f[n][i];
        sums.f[i][kThrough[n]] += law.zeta * f[n][i];
      }
    }
  }
}

/// (M.1) to (M.3) of the solid-shell.
void curve_solid_shell(const ElementLaw& law,
                       const MotionState& state,
                       const Cords& cords,
                       const Kinematics& m,
                       V* alpha1,
                       V* alpha2,
                       ModalSums& sums) {
  const SolidShellShape& s = law.shape->solid_shell;
  V c1[kSquareCount], g1[kStrains], g2[kStrains], t[3][kStrains];
  V e1[ElementLaw::kCordLayers][4], e2[ElementLaw::kCordLayers][4];
  first_response(s, state, cords, m, c1, g1, e1, alpha1);
  second_strains(s, state.k, m, c1, g2);
  for (int j = 0; j < kEnhanced; ++j) alpha2[j] = 0.0;
  for (int l = 0; l < cords.count(); ++l) {
    const CordSheet& sheet = cords.laws[l];
    V y[3][3], G[6];
    vectors_of(m.x, sheet.zeta, y);
    gram(y, y, G);
    for (int q = 0; q < 4; ++q) {
      const CordSheet::Point& point = sheet.points[q];
      e2[l][q] = times_gram(point, G);
      e1[l][q] += point.p[0] * alpha1[0] + point.p[1] * alpha1[1];
      const V S =
          point.dV * (bend_of(sheet.layer, cords.sheets[l].points[q].e) * (e1[l][q] * e1[l][q]));
      alpha2[0] += point.p[0] * S;
      alpha2[1] += point.p[1] * S;
    }
  }
  for (int n = 0; n < kStrains; ++n) {
    t[0][n] = state.t[n];
    V first = 0.0, second = 0.0;
    for (int c = 0; c < kStrains; ++c) {
      first += state.D[n][c] * g1[c];
      second += state.D[n][c] * g2[c];
    }
    for (int j = 0; j < kEnhanced; ++j) first += state.Da[j][n] * alpha1[j];
    t[1][n] = first;
    t[2][n] = second;
  }
  for (int q = 0; q < kPoints && !law.linear; ++q) {
    V E1[6], S[6];
    for (int r = 0; r < 6; ++r) {
      V sum = s.P[q][r][0] * g1[0];
      for (int j = 1; j < kStrains; ++j) sum += s.P[q][r][j] * g1[j];
      for (int j = 0; j < kEnhanced; ++j) sum += s.P[q][r][kStrains + j] * alpha1[j];
      E1[r] = sum;
    }
    second_stress(law.rubber, state.rubber[q], E1, S);
    for (int r = 0; r < 6; ++r) {
      const V dS = law.shape->dV[q] * S[r];
      for (int j = 0; j < kStrains; ++j) t[2][j] += s.P[q][r][j] * dS;
      for (int j = 0; j < kEnhanced; ++j) alpha2[j] += s.P[q][r][kStrains + j] * dS;
    }
  }
  respond(state, cords, g2, e2, alpha2);
  for (int n = 0; n < kStrains; ++n) {
    for (int j = 0; j < kEnhanced; ++j) t[2][n] += state.Da[j][n] * alpha2[j];
  }
  for (int l = 0; l < cords.count(); ++l) {
    for (int q = 0; q < 4; ++q) {
      const double* p = cords.laws[l].points[q].p;
      e2[l][q] += p[0] * alpha2[0] + p[1] * alpha2[1];
    }
  }
  add_second_forces(s, state.k, m, c1, t, sums);
  add_second_forces(cords, m, e1, e2, sums);
}

/// F of a point of the comparison element, [row i][column k].
LATSCH_INLINE void gradient(const double (*dN)[8], const V* x, V (*F)[3]) {
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      V sum = dN[k][0] * x[i];
      for (int a = 1; a < 8; ++a) sum += dN[k][a] * x[3 * a + i];
      F[i][k] = sum;
    }
  }
}
/// Strain of F^T G, symmetric part twice where `whole`: as engineering strains.
LATSCH_INLINE void strain_of(const V (*F)[3], const V (*G)[3], V* E) {
  for (int r = 0; r < 6; ++r) {
    const int k = voigt::kRow[r], l = voigt::kColumn[r];
    V sum = 0.0;
    for (int i = 0; i < 3; ++i) sum += F[i][k] * G[i][l];
    if (r >= 3) {
      for (int i = 0; i < 3; ++i) sum += F[i][l] * G[i][k];
    }
    E[r] = sum;
  }
}

/// (M.3) of the comparison element, solid alone.
void curve_full_integration(const ElementLaw& law, const V* x, const V* phi, NodalSums& sums) {
  const HexShape& shape = *law.shape;
  for (int q = 0; q < kPoints; ++q) {
    V F[3][3], G[3][3], E[6], E1[6], E2[6], S[6], D[6][6], S1[6], S2[6];
    gradient(shape.dN[q], x, F);
    gradient(shape.dN[q], phi, G);
    strain_of(F, F, E);
    for (int r = 0; r < 6; ++r) E[r] = r < 3 ? V(0.5 * (E[r] - 1.0)) : V(0.5 * E[r]);
    strain_of(F, G, E1);
    strain_of(G, G, E2);
    stress(law, shape.dV[q], E, S, D);
    for (int r = 0; r < 6; ++r) S2[r] = 0.0;
    if (!law.linear) {
      RubberPoint point;
      prepare(law.rubber, E, point);
      second_stress(law.rubber, point, E1, S2);
    }
    for (int r = 0; r < 6; ++r) {
      S1[r] = 0.0;
      S2[r] = shape.dV[q] * S2[r];
      for (int c = 0; c < 6; ++c) {
        S1[r] += D[r][c] * E1[c];
        S2[r] += D[r][c] * E2[c];
      }
    }
    for (int i = 0; i < 3; ++i) {
      V a[3], b[3];
      times_strain_operator(F[i], S2, a);
      times_strain_operator(G[i], S1, b);
      for (int k = 0; k < 3; ++k) a[k] += 2.0 * b[k];
      for (int n = 0; n < 8; ++n) {
        const auto* dN = shape.dN[q];
        V& f = sums.f[3 * n + i];
        f = dN[0][n] * a[0] + (dN[1][n] * a[1] + (dN[2][n] * a[2] + f));
      }
    }
  }
}

bool curve_register(const ElementLaw& law,
                    const ElementSurroundings& around,
                    int first,
                    const ElementBatch& batch,
                    std::span<ElementMotion> motions) {
  static constexpr double kNowhere[24] = {};
  Cords cords(law.cords);
  MotionState state;
  if (!every(set_state(law, first, batch, state, cords))) return false;
  if (law.shape->kind == ElementKind::solid_shell) {
    for (int l = 0; l < cords.count(); ++l) {  // strains with those of alpha
      for (int q = 0; q < 4; ++q) {
        const double* p = cords.laws[l].points[q].p;
        V& e = cords.sheets[l].points[q].e;
        e += p[0] * state.alpha[0] + p[1] * state.alpha[1];
      }
    }
  }
  for (ElementMotion& motion : motions) {
    V phi[24], alpha1[kEnhanced], alpha2[kEnhanced];
    for (int j = 0; j < kEnhanced; ++j) alpha1[j] = alpha2[j] = 0.0;
    Kinematics m;
    motion_of(*law.shape, motion.mode, first, phi, m);
    ModalSums modal;
    modal.set_zero(false);
    NodalSums sums;
    if (law.shape->kind == ElementKind::solid_shell) {
      curve_solid_shell(law, state, cords, m, alpha1, alpha2, modal);
    } else {
      V e1[ElementLaw::kCordLayers][4], e2[ElementLaw::kCordLayers][4];
      for (int l = 0; l < cords.count(); ++l) {
        V y[3][3], G1[6], G2[6];
        vectors_of(m.x, cords.laws[l].zeta, y);
        gram(y, cords.sheets[l].y, G1);
        gram(y, y, G2);
        for (int q = 0; q < 4; ++q) {
          e1[l][q] = times_gram(cords.laws[l].points[q], G1);
          e2[l][q] = times_gram(cords.laws[l].points[q], G2);
        }
      }
      add_second_forces(cords, m, e1, e2, modal);
    }
    to_nodes(modal, sums);
    if (law.shape->kind == ElementKind::full_integration) {
      curve_full_integration(law, state.x, phi, sums);
    }
    // The gas' energy is of third order in the places: its forces' second derivative is twice the
    // forces at the motion in their place.
    if (around.pressure != 0.0)
      add_pressure(kNowhere, phi, around.open_edges, 2.0 * around.pressure, false, sums);
    if (around.turned != 0) turn(around, false, sums);
    for (int n = 0; n < 24; ++n) sums.f[n].save(motion.curvature[n] + first);
    for (int j = 0; j < kEnhanced; ++j) {
      alpha1[j].save(motion.mode_alpha[j] + first);
      alpha2[j].save(motion.second_alpha[j] + first);
    }
  }
  return true;
}

bool curve_batch(const ElementLaw& law,
                 const ElementSurroundings& around,
                 const ElementBatch& batch,
                 std::span<ElementMotion> motions) {
  for (int first = 0; first < batch.count; first += V::kWidth) {
    if (!curve_register(law, around, first, batch, motions)) return false;
  }
  return true;
}

bool follow_batch(const ElementLaw& law,
                  const ElementBatch& batch,
                  std::span<ElementMotion> motions) {
  for (int first = 0; first < batch.count; first += V::kWidth) {
    Cords cords(law.cords);
    MotionState state;
    if (!every(set_state(law, first, batch, state, cords))) return false;
    for (ElementMotion& motion : motions) {
      V zeta[24], alpha[kEnhanced], c1[kSquareCount], g[kStrains], e[ElementLaw::kCordLayers][4];
      for (int j = 0; j < kEnhanced; ++j) alpha[j] = 0.0;
      Kinematics m;
      motion_of(*law.shape, motion.along, first, zeta, m);
      if (law.shape->kind == ElementKind::solid_shell)
        first_response(law.shape->solid_shell, state, cords, m, c1, g, e, alpha);
      for (int j = 0; j < kEnhanced; ++j) {
        if (motion.has_mode) alpha[j] += load(motion.second_alpha[j] + first);
        alpha[j].save(motion.along_alpha[j] + first);
      }
    }
  }
  return true;
}

/// Strains at the points of one shape: of the state E, of the motions first and second derivatives
/// as (M.4) takes them.
struct MotionStrains {
  V x[24], modal[kModes][3], alpha[kEnhanced], E[kPoints][6];
  struct Motion {
    V phi[24], zeta[24], phi_modal[kModes][3], zeta_modal[kModes][3];
    V phi_alpha[kEnhanced], zeta_alpha[kEnhanced];
    V first[kPoints][6], second[kPoints][6];
  } motions[ElementMotion::kMost];
};

void strains_at(const ElementLaw& law,
                int first,
                const ElementBatch& batch,
                std::span<const ElementMotion> motions,
                bool solid,
                MotionStrains& at) {
  const HexShape& shape = *law.shape;
  const SolidShellShape& s = shape.solid_shell;
  const bool shell = shape.kind == ElementKind::solid_shell;
  for (int n = 0; n < 24; ++n) at.x[n] = load(batch.u[n] + first) + shape.X.data()[n];
  for (int j = 0; j < kEnhanced; ++j) at.alpha[j] = shell ? load(batch.alpha[j] + first) : V(0.0);
  Kinematics k;
  modal_vectors(at.x, k.x);
  std::memcpy(at.modal, k.x, sizeof k.x);
  const auto to_points = [&](const V* g, const V* alpha, V(*E)[6]) {
    for (int q = 0; q < kPoints; ++q) {
      for (int r = 0; r < 6; ++r) {
        V sum = s.P[q][r][0] * g[0];
        for (int j = 1; j < kStrains; ++j) sum += s.P[q][r][j] * g[j];
        for (int j = 0; j < kEnhanced; ++j) sum += s.P[q][r][kStrains + j] * alpha[j];
        E[q][r] = sum;
      }
    }
  };
  if (shell) {
    follow(s, k);
    V g[kStrains];
    generalized_strains(s, k, g);
    to_points(g, at.alpha, at.E);
  } else if (solid) {
    for (int q = 0; q < kPoints; ++q) {
      V F[3][3];
      gradient(shape.dN[q], at.x, F);
      strain_of(F, F, at.E[q]);
      for (int r = 0; r < 6; ++r)
        at.E[q][r] = r < 3 ? V(0.5 * (at.E[q][r] - 1.0)) : V(0.5 * at.E[q][r]);
    }
  }
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const ElementMotion& of = motions[i];
    MotionStrains::Motion& motion = at.motions[i];
    Kinematics m, z;
    motion_of(shape, of.along, first, motion.zeta, z);
    std::memcpy(motion.zeta_modal, z.x, sizeof z.x);
    if (of.has_mode) {
      motion_of(shape, of.mode, first, motion.phi, m);
      std::memcpy(motion.phi_modal, m.x, sizeof m.x);
    }
    for (int j = 0; j < kEnhanced; ++j) {
      motion.phi_alpha[j] = shell && of.has_mode ? load(of.mode_alpha[j] + first) : V(0.0);
      motion.zeta_alpha[j] = shell ? load(of.along_alpha[j] + first) : V(0.0);
    }
    if (!solid) continue;
    if (shell) {
      V c1[kSquareCount], g1[kStrains], g2[kStrains], gz[kStrains];
      first_strains(s, k, z, c1, gz);
      if (of.has_mode) {
        first_strains(s, k, m, c1, g1);
        second_strains(s, k, m, c1, g2);
        for (int j = 0; j < kStrains; ++j) gz[j] += g2[j];
        to_points(g1, motion.phi_alpha, motion.first);
      }
      to_points(gz, motion.zeta_alpha, motion.second);
      continue;
    }
    for (int q = 0; q < kPoints; ++q) {
      V F[3][3], G[3][3], Z[3][3], E2[6];
      gradient(shape.dN[q], at.x, F);
      gradient(shape.dN[q], motion.zeta, Z);
      strain_of(F, Z, motion.second[q]);
      if (!of.has_mode) continue;
      gradient(shape.dN[q], motion.phi, G);
      strain_of(F, G, motion.first[q]);
      strain_of(G, G, E2);
      for (int r = 0; r < 6; ++r) motion.second[q][r] += E2[r];
    }
  }
}

/// The solid's share of (M.4).
void sum_solid(const ElementLaw& law,
               std::span<const ElementMotion> motions,
               const MotionStrains& at,
               V* sums) {
  const HexShape& shape = *law.shape;
  for (int q = 0; q < kPoints; ++q) {
    V S[6], D[6][6];
    stress(law, shape.dV[q], at.E[q], S, D);
    for (std::size_t i = 0; i < motions.size(); ++i) {
      const MotionStrains::Motion& motion = at.motions[i];
      V sum = sums[i];
      for (int r = 0; r < 6; ++r) sum += S[r] * motion.second[q][r];
      for (int r = 0; r < 6 && motions[i].has_mode; ++r) {
        V row = D[r][0] * motion.first[q][0];
        for (int c = 1; c < 6; ++c) row += D[r][c] * motion.first[q][c];
        sum += row * motion.first[q][r];
      }
      sums[i] = sum;
    }
  }
  if (shape.kind == ElementKind::full_integration) return;
  for (int j = 5; j < kEnhanced; ++j) {
    const double relaxed = law.relaxation * shape.solid_shell.volume / (j == 7 ? 9.0 : 3.0);
    for (std::size_t i = 0; i < motions.size(); ++i) {
      const MotionStrains::Motion& motion = at.motions[i];
      sums[i] += relaxed *
                 (at.alpha[j] * motion.zeta_alpha[j] + motion.phi_alpha[j] * motion.phi_alpha[j]);
    }
  }
}

void sum_cords(const ElementLaw& law,
               std::span<const ElementMotion> motions,
               const MotionStrains& at,
               V* sums) {
  for (const CordSheet& sheet : law.cords) {
    V y[3][3], G0[6], S[4], tangent[4];
    vectors_of(at.modal, sheet.zeta, y);
    gram(y, y, G0);
    for (int q = 0; q < 4; ++q) {
      const CordSheet::Point& point = sheet.points[q];
      const V e = 0.5 * (times_gram(point, G0) - 1.0) +
                  (point.p[0] * at.alpha[0] + point.p[1] * at.alpha[1]);
      stretch(sheet.layer, e, S[q], tangent[q]);
      S[q] = point.dV * S[q];
      tangent[q] = point.dV * tangent[q];
    }
    for (std::size_t i = 0; i < motions.size(); ++i) {
      const MotionStrains::Motion& motion = at.motions[i];
      V y1[3][3], yz[3][3], G1[6], G2[6], Gz[6];
      vectors_of(motion.zeta_modal, sheet.zeta, yz);
      gram(yz, y, Gz);
      if (motions[i].has_mode) {
        vectors_of(motion.phi_modal, sheet.zeta, y1);
        gram(y1, y, G1);
        gram(y1, y1, G2);
        for (int k = 0; k < 6; ++k) Gz[k] += G2[k];
      }
      V sum = sums[i];
      for (int q = 0; q < 4; ++q) {
        const CordSheet::Point& point = sheet.points[q];
        const V second = times_gram(point, Gz) +
                         (point.p[0] * motion.zeta_alpha[0] + point.p[1] * motion.zeta_alpha[1]);
        sum += S[q] * second;
        if (!motions[i].has_mode) continue;
        const V e1 = times_gram(point, G1) +
                     (point.p[0] * motion.phi_alpha[0] + point.p[1] * motion.phi_alpha[1]);
        sum += tangent[q] * (e1 * e1);
      }
      sums[i] = sum;
    }
  }
}

/// The gas' share: forces f are homogeneous of second order, so Df[phi] = f(x + phi) - f(x) -
/// f(phi).
void sum_gas(const ElementLaw& law,
             double pressure,
             unsigned open_edges,
             std::span<const ElementMotion> motions,
             const MotionStrains& at,
             V* sums) {
  static constexpr double kNowhere[24] = {};
  const double* X = law.shape->X.data();
  NodalSums rest, here;
  for (V& f : rest.f) f = 0.0;
  add_pressure(X, at.x, open_edges, pressure, false, rest);
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const MotionStrains::Motion& motion = at.motions[i];
    for (int n = 0; n < 12; ++n) sums[i] += rest.f[n] * motion.zeta[n];
    if (!motions[i].has_mode) continue;
    V moved[12];
    for (int n = 0; n < 12; ++n) {
      moved[n] = at.x[n] + motion.phi[n];
      here.f[n] = -rest.f[n];
    }
    add_pressure(X, moved, open_edges, pressure, false, here);
    add_pressure(kNowhere, motion.phi, open_edges, -pressure, false, here);
    for (int n = 0; n < 12; ++n) sums[i] += here.f[n] * motion.phi[n];
  }
}

void sum_motions_of_batch(std::span<const VariedElement> varied,
                          unsigned open_edges,
                          const ElementBatch& batch,
                          std::span<const ElementMotion> motions,
                          MotionStrains& at,
                          double (*result)[ElementBatch::kLanes]) {
  const std::size_t count = motions.size();
  for (int first = 0; first < batch.count; first += V::kWidth) {
    const HexShape* shape = nullptr;
    bool has_solid = false;
    for (std::size_t v = 0; v < varied.size(); ++v) {
      const VariedElement& of = varied[v];
      if (of.law->shape != shape || (of.solid && !has_solid)) {
        has_solid = of.solid || shape == of.law->shape;
        for (const VariedElement& other : varied)
          has_solid = has_solid || (other.solid && other.law->shape == of.law->shape);
        shape = of.law->shape;
        strains_at(*of.law, first, batch, motions, has_solid, at);
      }
      V sums[ElementMotion::kMost];
      for (std::size_t i = 0; i < count; ++i) sums[i] = 0.0;
      if (of.solid) sum_solid(*of.law, motions, at, sums);
      if (of.cords) sum_cords(*of.law, motions, at, sums);
      if (of.gas && of.pressure != 0.0)
        sum_gas(*of.law, of.pressure, open_edges, motions, at, sums);
      for (std::size_t i = 0; i < count; ++i) sums[i].save(result[v * count + i] + first);
    }
  }
}

/// The same with a place for the strains.
void sum_motions_batch(std::span<const VariedElement> varied,
                       unsigned open_edges,
                       const ElementBatch& batch,
                       std::span<const ElementMotion> motions,
                       double (*result)[ElementBatch::kLanes]) {
  static thread_local MotionStrains at;
  sum_motions_of_batch(varied, open_edges, batch, motions, at, result);
}

}  // namespace latsch::fe_tire::LATSCH_KERNELS
#endif
