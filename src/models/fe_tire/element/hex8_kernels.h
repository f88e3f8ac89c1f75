// SPDX-License-Identifier: Apache-2.0
// A register full of elements from beginning to end: laws, pressure, the next sector's frame.
#include "models/fe_tire/element/hex8_full_integration_kernel.h"
#include "models/fe_tire/element/pressure_kernel.h"

namespace latsch::fe_tire::LATSCH_KERNELS {

/// Turns forces and stiffness of the nodes `around.turned` by Q^T.
void turn(const ElementSurroundings& around, bool stiffness, NodalSums& sums) {
  const double c = around.cosine, s = around.sine;
  const auto turn_pair = [&](V& x, V& z) {
    const V turned_x = c * x - s * z;
    z = s * x + c * z;
    x = turned_x;
  };
  const auto at = [&](int row, int column) -> V& {
    return sums
        .K[row >= column ? ElementBatch::entry(row, column) : ElementBatch::entry(column, row)];
  };
  for (int a = 0; a < 8; ++a) {
    if (!(around.turned >> a & 1)) continue;
    const int x = 3 * a, z = 3 * a + 2;
    turn_pair(sums.f[x], sums.f[z]);
    if (!stiffness) continue;
    for (int column = 0; column < 24; ++column) {
      if (column != x && column != z) turn_pair(at(x, column), at(z, column));
    }
    V xx = at(x, x), xz = at(z, x), zx = xz, zz = at(z, z);
    turn_pair(xx, zx);
    turn_pair(xz, zz);
    turn_pair(xx, xz);
    turn_pair(zx, zz);
    at(x, x) = xx;
    at(z, x) = xz;
    at(z, z) = zz;
  }
}

unsigned evaluate_register(const ElementLaw& law,
                           const ElementSurroundings& around,
                           bool stiffness,
                           int first,
                           ElementBatch& batch) {
  const HexShape& shape = *law.shape;
  V x[24], alpha[kEnhanced];
  for (int k = 0; k < 24; ++k) x[k] = load(batch.u[k] + first) + shape.X.data()[k];
  for (int j = 0; j < kEnhanced; ++j) alpha[j] = load(batch.alpha[j] + first);
  Kinematics k;
  modal_vectors(x, k.x);
  Cords cords(law.cords);
  follow(k.x, cords);
  ModalSums modal;
  modal.set_zero(stiffness);
  NodalSums sums;
  Mask valid;
  if (shape.kind == ElementKind::solid_shell) {
    valid = add_solid_shell(law, stiffness, k, cords, alpha, modal);
  } else {
    stretch(cords, 0.0, 0.0);
    add_forces(cords, modal);
    if (stiffness) add_stiffness(cords, modal, nullptr);
  }
  to_nodes(modal, sums);
  if (stiffness) stiffness_to_nodes(modal, sums);
  if (shape.kind == ElementKind::full_integration) {
    valid = add_full_integration(law, stiffness, x, sums);
  }
  if (around.pressure != 0.0) {
    add_pressure(shape.X.data(), x, around.open_edges, around.pressure, stiffness, sums);
  }
  if (around.turned != 0) turn(around, stiffness, sums);
  for (int j = 0; j < kEnhanced; ++j) alpha[j].save(batch.alpha[j] + first);
  for (int n = 0; n < 24; ++n) sums.f[n].save(batch.f[n] + first);
  for (int n = 0; stiffness && n < ElementBatch::kEntries; ++n) sums.K[n].save(batch.K[n] + first);
  return lanes_of(valid) << first;
}

unsigned evaluate_batch(const ElementLaw& law,
                        const ElementSurroundings& around,
                        bool stiffness,
                        ElementBatch& batch) {
  unsigned valid = 0;
  for (int first = 0; first < batch.count; first += V::kWidth) {
    valid |= evaluate_register(law, around, stiffness, first, batch);
  }
  return valid;
}

/// S and dS/de.
void cord_at(const CordLayer& layer, double e, double* S, double* tangent) {
  V stress, slope;
  stretch(layer, e, stress, slope);
  double lanes[V::kWidth];
  stress.save(lanes);
  *S = lanes[0];
  slope.save(lanes);
  *tangent = lanes[0];
}

/// Of one face.
void pressure_at(const double* x, double p, double* f, double* K) {
  NodalSums sums;
  for (V& v : sums.f) v = 0.0;
  for (V& v : sums.K) v = 0.0;
  V at[12];
  for (int k = 0; k < 12; ++k) at[k] = x[k];
  add_pressure(x, at, 0, p, true, sums);
  double lanes[V::kWidth];
  for (int k = 0; k < 12; ++k) {
    sums.f[k].save(lanes);
    f[k] = lanes[0];
  }
  for (int k = 0; k < ElementBatch::entry(12, 0); ++k) {
    sums.K[k].save(lanes);
    K[k] = lanes[0];
  }
}

double rubber_at(const Hyperelastic& law, const double* E, double* S, double (*D)[6]) {
  V strain[6], stress[6], tangent[6][6];
  for (int k = 0; k < 6; ++k) strain[k] = E[k];
  const V det = rubber_law::stress(law, strain, stress, tangent);
  double lanes[V::kWidth];
  for (int k = 0; k < 6; ++k) {
    stress[k].save(lanes);
    S[k] = lanes[0];
    for (int l = 0; l < 6; ++l) {
      tangent[k][l].save(lanes);
      D[k][l] = lanes[0];
    }
  }
  det.save(lanes);
  return lanes[0];
}

}  // namespace latsch::fe_tire::LATSCH_KERNELS

#include "models/fe_tire/element/hex8_curvatures_kernel.h"
#include "models/fe_tire/element/hex8_motion_sums_kernel.h"
