// SPDX-License-Identifier: Apache-2.0
// State of an element, and the derivative of its enhanced strains along a motion of its nodes:
// (M.1) of hex8_motions.h.
//
// This file is included once per kernel set, by hex8_kernels.h only.
#if defined(LATSCH_FE_TIRE_HEX8_MOTION_STATE) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_FE_TIRE_HEX8_MOTION_STATE
#undef LATSCH_FE_TIRE_HEX8_MOTION_STATE
#else
#define LATSCH_FE_TIRE_HEX8_MOTION_STATE
#endif

#include "models/fe_tire/element/cord_motions_kernel.h"
#include "models/fe_tire/element/hex8_strain_motions_kernel.h"
#include "models/fe_tire/element/rubber_motions_kernel.h"

namespace latsch::fe_tire::LATSCH_KERNELS {

/// State of an element, with the quantities that are the same for all motions about it.
struct MotionState {
  Kinematics k;
  V x[24], alpha[kEnhanced], g[kStrains], E[kPoints][6];
  V t[kStrains], D[kStrains][kStrains], Da[kEnhanced][kStrains];
  Inner inner;
  RubberPoint rubber[kPoints];
};

/// Computes the state, except for t, D, Da, E and rubber, which only second derivatives need, and
/// the state of `cords`. Returns false in lanes in which the element is inverted.
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
  for (int j = 0; j < kStrains; ++j) state.g[j] = g[j];
  return valid;
}

/// Computes the remaining members t, D, Da, E and rubber.
void set_tangents(const ElementLaw& law, MotionState& state) {
  const SolidShellShape& s = law.shape->solid_shell;
  for (int j = 0; j < kStrains; ++j) state.t[j] = 0.0;
  for (int q = 0; q < kPoints; ++q) {
    for (int r = 0; r < 6; ++r) {
      V sum = s.P[q][r][0] * state.g[0];
      for (int j = 1; j < kStrains; ++j) sum += s.P[q][r][j] * state.g[j];
      for (int j = 0; j < kEnhanced; ++j) sum += s.P[q][r][kStrains + j] * state.alpha[j];
      state.E[q][r] = sum;
      for (int j = 0; j < kStrains; ++j) state.t[j] += s.P[q][r][j] * state.inner.S[q][r];
    }
    if (!law.linear) prepare(law.rubber, state.E[q], state.rubber[q]);
  }
  tangents(s, state.inner, state.D, state.Da);
}

/// Multiplies W_au by derivatives g of the generalized strains, point by point. For few motions
/// this is cheaper than computing the matrix Da.
LATSCH_INLINE void couple(const SolidShellShape& s, const Inner& inner, const V* g, V* sums) {
  for (int j = 0; j < kEnhanced; ++j) sums[j] = 0.0;
  for (int q = 0; q < kPoints; ++q) {
    V E[6];
    for (int r = 0; r < 6; ++r) {
      V sum = s.P[q][r][0] * g[0];
      for (int j = 1; j < kStrains; ++j) sum += s.P[q][r][j] * g[j];
      E[r] = sum;
    }
    for (int r = 0; r < 6; ++r) {
      V S = inner.D[q][r][0] * E[0];
      for (int c = 1; c < 6; ++c) S += inner.D[q][r][c] * E[c];
      for (int j = 0; j < kEnhanced; ++j) sums[j] += s.P[q][r][kStrains + j] * S;
    }
  }
}

/// Computes the derivative of alpha along a motion, (M.1). On entry `response` holds W_au times the
/// derivatives of the generalized strains; e holds the derivatives of the cords' strains.
LATSCH_INLINE void respond(const Inner& inner, const Cords& cords, const V (*e)[4], V* response) {
  for (int l = 0; l < cords.count(); ++l) {
    for (int q = 0; q < 4; ++q) {
      const CordSheet::Point& point = cords.laws[l].points[q];
      const V S = point.dV * (cords.sheets[l].points[q].tangent * e[l][q]);
      response[0] += point.p[0] * S;
      response[1] += point.p[1] * S;
    }
  }
  solve(inner.A, response);
  for (int j = 0; j < kEnhanced; ++j) response[j] = -response[j];
}

/// Computes the derivative of alpha along a motion with the matrix Da.
LATSCH_INLINE void respond(
    const MotionState& state, const Cords& cords, const V* g, const V (*e)[4], V* response) {
  for (int j = 0; j < kEnhanced; ++j) {
    for (int n = 0; n < kStrains; ++n) response[j] += state.Da[j][n] * g[n];
  }
  respond(state.inner, cords, e, response);
}

/// Computes the first derivatives of the cords' strains along a motion.
LATSCH_INLINE void first_strains(const Cords& cords, const Kinematics& m, V (*e)[4]) {
  for (int l = 0; l < cords.count(); ++l) {
    V y[3][3], G[6];
    vectors_of(m.x, cords.laws[l].zeta, y);
    gram(y, cords.sheets[l].y, G);
    for (int q = 0; q < 4; ++q) e[l][q] = times_gram(cords.laws[l].points[q], G);
  }
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

}  // namespace latsch::fe_tire::LATSCH_KERNELS
#endif
