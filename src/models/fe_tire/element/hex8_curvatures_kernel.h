// SPDX-License-Identifier: Apache-2.0
// Evaluates equations (M.1) to (M.3) of hex8_motions.h for both kinds of elements.
//
// The derivatives of strains along a motion are written out. The stresses S, S', S'' follow from
// them with the law's tangent D and its derivative along a strain.
//
// This file is included once per kernel set, by hex8_kernels.h only.
#if defined(LATSCH_FE_TIRE_HEX8_CURVATURES) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_FE_TIRE_HEX8_CURVATURES
#undef LATSCH_FE_TIRE_HEX8_CURVATURES
#else
#define LATSCH_FE_TIRE_HEX8_CURVATURES
#endif

#include "models/fe_tire/element/full_integration_motions_kernel.h"
#include "models/fe_tire/element/hex8_motion_state_kernel.h"
#include "models/fe_tire/element/pressure_kernel.h"

namespace latsch::fe_tire::LATSCH_KERNELS {

/// Multiplies the matrix D by two vectors a and b. Several rows are computed in registers at once,
/// so that D is read only once.
LATSCH_INLINE void times_tangent(const V (*D)[kStrains], const V* a, const V* b, V* D_a, V* D_b) {
  constexpr int kTogether = 6;
  static_assert(kStrains % kTogether == 0);
  for (int first = 0; first < kStrains; first += kTogether) {
    V of_a[kTogether], of_b[kTogether];
    for (int n = 0; n < kTogether; ++n) of_a[n] = of_b[n] = 0.0;
    for (int c = 0; c < kStrains; ++c) {
      for (int n = 0; n < kTogether; ++n) {
        const V d = D[first + n][c];
        of_a[n] += d * a[c];
        of_b[n] += d * b[c];
      }
    }
    for (int n = 0; n < kTogether; ++n) {
      D_a[first + n] = of_a[n];
      D_b[first + n] = of_b[n];
    }
  }
}

/// Computes (M.1) to (M.3) for the solid-shell element.
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
  first_strains(s, state.k, m, c1, g1);
  first_strains(cords, m, e1);
  for (int j = 0; j < kEnhanced; ++j) alpha1[j] = 0.0;
  respond(state, cords, g1, e1, alpha1);
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
  for (int n = 0; n < kStrains; ++n) t[0][n] = state.t[n];
  times_tangent(state.D, g1, g2, t[1], t[2]);
  for (int n = 0; n < kStrains; ++n) {
    for (int j = 0; j < kEnhanced; ++j) t[1][n] += state.Da[j][n] * alpha1[j];
  }
  if (!law.linear) {
    V E1[kPoints][6];
    to_points<1>(s, {g1}, {alpha1}, {E1});
    for (int q = 0; q < kPoints; ++q) {
      V S[6];
      second_stress(law.rubber, state.rubber[q], E1[q], S);
      for (int r = 0; r < 6; ++r) E1[q][r] = law.shape->dV[q] * S[r];
    }
    from_points(s, E1, t[2], alpha2);
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
    set_tangents(law, state);
    for (int l = 0; l < cords.count(); ++l) {  // strains that include the contribution of alpha
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
    // The energy of the gas is cubic in the positions. The second derivative of its forces along a
    // motion is therefore twice the forces with the motion in place of the positions.
    if (around.pressure != 0.0)
      add_pressure(kNowhere,
                   phi,
                   {around.open_edges, law.shape->arc.is_arc},
                   2.0 * around.pressure,
                   false,
                   sums);
    forces_to_frames(law.shape->arc, around, sums);
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
      if (law.shape->kind == ElementKind::solid_shell) {
        first_strains(law.shape->solid_shell, state.k, m, c1, g);
        first_strains(cords, m, e);
        couple(law.shape->solid_shell, state.inner, g, alpha);
        respond(state.inner, cords, e, alpha);
      }
      for (int j = 0; j < kEnhanced; ++j) {
        if (motion.has_mode) alpha[j] += load(motion.second_alpha[j] + first);
        alpha[j].save(motion.along_alpha[j] + first);
      }
    }
  }
  return true;
}

}  // namespace latsch::fe_tire::LATSCH_KERNELS
#endif
