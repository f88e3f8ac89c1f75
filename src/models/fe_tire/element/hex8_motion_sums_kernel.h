// SPDX-License-Identifier: Apache-2.0
// Computes the sums (M.4) of hex8_motions.h for elements whose parameters (moduli, angles,
// coordinates ...) are changed, for both kinds of elements. The strains of the state and of its
// prescribed motions are computed once for all parameters that do not change the shape.
//
// This file is included once per kernel set, by hex8_kernels.h only.
#if defined(LATSCH_FE_TIRE_HEX8_MOTION_SUMS) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_FE_TIRE_HEX8_MOTION_SUMS
#undef LATSCH_FE_TIRE_HEX8_MOTION_SUMS
#else
#define LATSCH_FE_TIRE_HEX8_MOTION_SUMS
#endif

#include "models/fe_tire/element/full_integration_motions_kernel.h"
#include "models/fe_tire/element/hex8_motion_state_kernel.h"
#include "models/fe_tire/element/pressure_kernel.h"

namespace latsch::fe_tire::LATSCH_KERNELS {

/// Strains at the points of one shape: E of the state, and first and second derivatives along the
/// motions, as (M.4) uses them.
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
  if (shell) {
    follow(s, k);
    V g[kStrains];
    generalized_strains(s, k, g);
    to_points<1>(s, {g}, {at.alpha}, {at.E});
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
        to_points<2>(
            s, {g1, gz}, {motion.phi_alpha, motion.zeta_alpha}, {motion.first, motion.second});
      } else {
        to_points<1>(s, {gz}, {motion.zeta_alpha}, {motion.second});
      }
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

/// Adds the contribution of the solid to (M.4).
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
               unsigned layers,
               std::span<const ElementMotion> motions,
               const MotionStrains& at,
               V* sums) {
  for (std::size_t k = 0; k < law.cords.size(); ++k) {
    if (!(layers >> k & 1u)) continue;
    const CordSheet& sheet = law.cords[k];
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

/// Adds the contribution of the gas to (M.4). The forces f of the gas are homogeneous of second
/// order in the positions, so Df[phi] = f(x + phi) - f(x) - f(phi).
void sum_gas(const ElementLaw& law,
             double pressure,
             unsigned open_edges,
             std::span<const ElementMotion> motions,
             const MotionStrains& at,
             V* sums) {
  static constexpr double kNowhere[24] = {};
  const double* X = law.shape->X.data();
  const GasEdges edges{open_edges, law.shape->arc.is_arc};
  NodalSums rest, here;
  for (V& f : rest.f) f = 0.0;
  add_pressure(X, at.x, edges, pressure, false, rest);
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const MotionStrains::Motion& motion = at.motions[i];
    for (int n = 0; n < 12; ++n) sums[i] += rest.f[n] * motion.zeta[n];
    if (!motions[i].has_mode) continue;
    V moved[12];
    for (int n = 0; n < 12; ++n) {
      moved[n] = at.x[n] + motion.phi[n];
      here.f[n] = -rest.f[n];
    }
    add_pressure(X, moved, edges, pressure, false, here);
    add_pressure(kNowhere, motion.phi, edges, -pressure, false, here);
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
      if (of.cords != 0) sum_cords(*of.law, of.cords, motions, at, sums);
      if (of.gas && of.pressure != 0.0)
        sum_gas(*of.law, of.pressure, open_edges, motions, at, sums);
      for (std::size_t i = 0; i < count; ++i) sums[i].save(result[v * count + i] + first);
    }
  }
}

/// Calls sum_motions_of_batch() with memory for the strains.
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
